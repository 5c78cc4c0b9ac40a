// Looking back: a slider over the last minute, and the way back to now.

import { h, write } from "./dom.ts";
import { HISTORY_S } from "./history.ts";
import { fixed } from "./nice.ts";

const STEP_S = 0.05;

export class Timeline {
  private readonly slider: HTMLInputElement;
  private readonly live: HTMLButtonElement;
  private readonly text = h("output", { class: "ago" });
  private agoS = 0;

  /** `onChange`: seconds before now that are to be shown, 0 is live. */
  constructor(
    root: HTMLElement,
    private readonly onChange: (agoS: number) => void,
  ) {
    this.live = h("button", { type: "button", class: "live", "aria-pressed": "true", onclick: () => this.set(0) }, "Live");
    this.slider = h("input", {
      type: "range",
      min: -HISTORY_S,
      max: 0,
      step: STEP_S,
      value: 0,
      "aria-label": "Look back, seconds before now",
      oninput: () => this.set(-Number(this.slider.value)),
    });
    root.append(this.live, this.slider, this.text);
    this.show();
  }

  /** How far back there is something to see, s. */
  setReach(reachS: number): void {
    const min = -Math.min(HISTORY_S, Math.max(1, Math.ceil(reachS)));
    if (Number(this.slider.min) !== min) this.slider.min = String(min);
  }

  /** Further back, or nearer to now. */
  step(byS: number): void {
    this.set(Math.max(0, Math.min(this.agoS + byS, -Number(this.slider.min))));
  }

  set(agoS: number): void {
    this.agoS = agoS < STEP_S / 2 ? 0 : agoS;
    this.onChange(this.agoS);
    this.show();
  }

  private show(): void {
    const live = this.agoS === 0;
    this.slider.value = String(-this.agoS);
    this.slider.setAttribute("aria-valuetext", live ? "live" : `${this.agoS.toFixed(1)} seconds ago`);
    this.live.setAttribute("aria-pressed", String(live));
    write(this.text, live ? "now" : `${fixed(-this.agoS, 1)} s`);
  }
}
