// What the pointer does on the picture: look, press or pull, how deep, and who holds the device.

import { h, newId, write } from "./dom.ts";
import type { Hand, Tool } from "./hand.ts";
import { DEPTHS_M } from "./target.ts";

const TOOLS: readonly [Tool, string][] = [
  ["look", "Look"],
  ["press", "Press"],
  ["pull", "Pull"],
];

export class HandPanel {
  tool: Tool = "press";
  private readonly devices: HTMLSelectElement;
  private readonly slider: HTMLInputElement;
  private readonly depth = h("output", { class: "unit" });
  private readonly hold = h("span", { class: "hold", role: "status" });
  private names: readonly string[] = [];

  constructor(
    private readonly root: HTMLElement,
    private readonly hand: Hand,
    onTool: () => void,
  ) {
    const choices = TOOLS.map(([tool, name]) => {
      const input = h("input", { type: "radio", name: "tool", value: tool, onchange: () => {
        this.tool = tool;
        if (tool === "look") hand.release();
        onTool();
      } });
      input.checked = tool === this.tool;
      return h("label", {}, input, h("span", {}, name));
    });
    const id = newId();
    this.slider = h("input", {
      id,
      type: "range",
      min: 1000 * DEPTHS_M.least,
      max: 1000 * DEPTHS_M.most,
      step: 0.5,
      oninput: () => hand.setDepth(Number(this.slider.value) / 1000),
    });
    this.devices = h("select", { "aria-label": "Device at the pointer", onchange: () => {
      hand.release();
      hand.device = this.devices.value;
      this.show();
    } });
    root.append(
      h("fieldset", { class: "segments" }, h("legend", { class: "unseen" }, "Dragging on the body"), ...choices),
      this.devices,
      h("label", { for: id }, "Depth"),
      this.slider,
      this.depth,
      this.hold,
    );
    this.show();
  }

  /** Devices that a pointer moves. */
  setDevices(names: readonly string[]): void {
    if (names.length === this.names.length && names.every((name, i) => name === this.names[i])) return;
    this.names = names;
    this.devices.replaceChildren(...names.map((name) => h("option", { value: name }, name === "" ? "haptic_device" : name)));
    this.devices.hidden = names.length < 2;
    if (this.hand.device === null || !names.includes(this.hand.device)) {
      if (this.hand.device !== null) this.hand.release();
      this.hand.device = names[0] ?? null;
    }
    this.devices.value = this.hand.device ?? "";
    this.root.hidden = names.length === 0;
  }

  show(): void {
    const { hand } = this;
    this.slider.value = String(1000 * hand.depthM);
    write(this.depth, `${(1000 * hand.depthM).toFixed(1)} mm`);
    const texts = {
      free: "drag on the body to press",
      asked: "asking for the device",
      ours: hand.pulling ? "pulling" : hand.active ? "pressing" : "yours, Esc lets go",
      refused: hand.reason === "" ? "another page holds the device" : hand.reason,
    };
    const outOfReach = hand.hold === "ours" && hand.outOfReach;
    this.hold.dataset.level = (hand.hold === "refused" || outOfReach) && !hand.past ? "error" : "";
    write(this.hold, hand.past ? "looking back: a press goes to live" : outOfReach ? "out of the device's reach" : texts[hand.hold]);
  }
}
