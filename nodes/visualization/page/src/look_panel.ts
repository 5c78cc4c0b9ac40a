// How the picture is drawn: what is shown, and how large.

import { h, newId, remember, remembered, write } from "./dom.ts";
import type { Look } from "./stage.ts";

type Choices = Pick<Look, "chains" | "axes" | "opacity">;

export class LookPanel {
  readonly choices: Choices;
  private readonly chains: HTMLInputElement;

  constructor(
    root: HTMLElement,
    private readonly onChange: (choices: Choices) => void,
  ) {
    const opacity = Number(remembered("opacity") ?? "1");
    this.choices = {
      chains: remembered("chains") !== "false",
      axes: remembered("axes") !== "false",
      opacity: opacity >= 0.2 && opacity <= 1 ? opacity : 1,
    };
    this.chains = this.toggle("chains", "Rhombus chains");
    const axes = this.toggle("axes", "Frame at the body's origin");
    root.append(row(this.chains, "Rhombus chains"), row(axes, "Frame at the body's origin"), this.opacityRow());
    root.append(
      h("p", { class: "note key" },
        mark("rod", "rods"), mark("point", "mass points"), mark("normal", "normal springs"), mark("tangential", "tangential springs"),
      ),
    );
  }

  toggleChains(): void {
    this.chains.click();
  }

  private toggle(key: "chains" | "axes", label: string): HTMLInputElement {
    const input = h("input", {
      type: "checkbox",
      role: "switch",
      class: "switch",
      "aria-label": label,
      onchange: () => {
        this.choices[key] = input.checked;
        remember(key, String(input.checked));
        this.onChange(this.choices);
      },
    });
    input.checked = this.choices[key];
    return input;
  }

  private opacityRow(): HTMLElement {
    const id = newId();
    const output = h("output", { for: id, class: "unit" });
    const slider = h("input", {
      id,
      type: "range",
      min: 0.2,
      max: 1,
      step: 0.05,
      value: this.choices.opacity,
      oninput: () => {
        this.choices.opacity = Number(slider.value);
        remember("opacity", slider.value);
        write(output, `${Math.round(100 * this.choices.opacity)} %`);
        this.onChange(this.choices);
      },
    });
    write(output, `${Math.round(100 * this.choices.opacity)} %`);
    return h("div", { class: "look-row" }, h("label", { for: id }, "Opacity of the body"), slider, output);
  }
}

function row(input: HTMLInputElement, text: string): HTMLElement {
  return h("label", { class: "look-row" }, h("span", {}, text), input);
}

function mark(kind: string, text: string): HTMLElement {
  return h("span", {}, h("i", { class: `mark ${kind}`, "aria-hidden": "true" }), text);
}
