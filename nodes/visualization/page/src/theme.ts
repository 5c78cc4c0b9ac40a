// Dark or light: as the system has it, until the user chooses.

import { remember, remembered } from "./dom.ts";

type Choice = "system" | "light" | "dark";
const CHOICES: readonly Choice[] = ["system", "light", "dark"];

export class Theme {
  private choice: Choice;
  private readonly system = matchMedia("(prefers-color-scheme: dark)");

  /** `onChange` is called at once and after every change. */
  constructor(
    private readonly button: HTMLElement,
    private readonly onChange: () => void,
  ) {
    this.choice = CHOICES.find((one) => one === remembered("theme")) ?? "system";
    this.system.addEventListener("change", () => this.show());
    button.addEventListener("click", () => this.next());
    this.show();
  }

  get dark(): boolean {
    return this.choice === "system" ? this.system.matches : this.choice === "dark";
  }

  /** The other of dark and light first; then back to the system's. */
  private next(): void {
    const other: Choice = this.system.matches ? "light" : "dark";
    const order: Choice[] = ["system", other, other === "dark" ? "light" : "dark"];
    this.choice = order[(order.indexOf(this.choice) + 1) % order.length];
    remember("theme", this.choice);
    this.show();
  }

  private show(): void {
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    const label = `Theme: ${this.choice === "system" ? "as the system" : this.choice}`;
    this.button.setAttribute("aria-label", label);
    this.button.title = label;
    this.onChange();
  }
}

/** The value of a colour of the style sheet. */
export function colour(name: string): string {
  const probe = document.createElement("span");
  probe.style.color = `var(--${name})`;
  probe.hidden = true;
  document.body.append(probe);
  const value = getComputedStyle(probe).color;
  probe.remove();
  return value;
}

/** The colour of a device's lines. */
export const seriesColour = (index: number): string => colour(`series-${index % 4}`);

