// What the colours mean: the choice of a quantity, and its scale with unit.

import { colourScale, STEPS, type Quantity } from "./colours.ts";
import type { Scale } from "./colouring.ts";
import { h, write } from "./dom.ts";
import { short } from "./nice.ts";

const QUANTITIES: readonly [Quantity, string][] = [
  ["displacement", "Displacement"],
  ["force", "Force"],
  ["stiffness", "Stiffness"],
];

/** What a quantity is called. */
export const titleOf = (quantity: Quantity): string => QUANTITIES.find(([one]) => one === quantity)?.[1] ?? quantity;

/** What stands at the beginning, the middle and the end of a scale. */
export function labels({ from, to, unit }: Scale): [string, string, string] {
  if (from === to) return ["", `${short(from)} ${unit}`, ""];
  return [short(from), short((from + to) / 2), `${short(to)} ${unit}`];
}

export class Legend {
  private readonly inputs = new Map<Quantity, HTMLInputElement>();
  private readonly canvas = h("canvas", { width: STEPS, height: 1, class: "scale", role: "img" });
  private readonly ticks = [0, 1, 2].map(() => h("span"));
  private readonly note = h("p", { class: "note" });
  private shown = "";

  constructor(root: HTMLElement, chosen: Quantity, onChoose: (quantity: Quantity) => void) {
    const choices = QUANTITIES.map(([quantity, name]) => {
      const input = h("input", {
        type: "radio",
        name: "quantity",
        value: quantity,
        onchange: () => onChoose(quantity),
      });
      this.inputs.set(quantity, input);
      return h("label", {}, input, h("span", {}, name));
    });
    const row = h("fieldset", { class: "segments" }, h("legend", { class: "unseen" }, "Colour shows"), ...choices);
    root.append(row, this.canvas, h("div", { class: "ticks" }, ...this.ticks), this.note);
    this.choose(chosen);
  }

  choose(quantity: Quantity): void {
    const input = this.inputs.get(quantity);
    if (input) input.checked = true;
  }

  show(scale: Scale): void {
    const key = JSON.stringify(scale);
    if (key === this.shown) return;
    this.shown = key;
    const { from, to, unit } = scale;
    const texts = labels(scale);
    this.ticks.forEach((tick, i) => write(tick, texts[i]));
    const spoken = from === to ? texts[1] : `${short(from)} to ${short(to)} ${unit}`;
    this.canvas.setAttribute("aria-label", `Colour scale, ${scale.quantity}: ${spoken}`);
    this.canvas.title = scale.explanation;
    this.note.title = scale.explanation;
    write(this.note, scale.note);
    const colours = colourScale(scale.quantity);
    this.canvas.getContext("2d")?.putImageData(new ImageData(new Uint8ClampedArray(colours), STEPS, 1), 0, 0);
  }
}
