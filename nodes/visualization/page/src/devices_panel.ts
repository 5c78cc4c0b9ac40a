// One card for each device: what it does now, in numbers that can be read from a distance.

import { ForceDifference } from "./applied.ts";
import { h, write } from "./dom.ts";
import type { DeviceState } from "./frames.ts";
import { length } from "./vector.ts";
import type { DeviceStatus } from "./messages.ts";
import { fixed } from "./nice.ts";
import { seriesColour } from "./theme.ts";

interface Card {
  readonly root: HTMLElement;
  readonly mark: HTMLElement;
  readonly state: HTMLElement;
  readonly mode: HTMLElement;
  readonly numbers: readonly HTMLElement[];
  readonly note: HTMLElement;
  readonly difference: ForceDifference;
}

const NUMBERS = [
  ["Depth", "mm"],
  ["Force", "N"],
  ["Stiffness", "N/mm"],
  ["Rate", "Hz"],
  ["Latency", "ms"],
] as const;

export class DevicesPanel {
  private cards: Card[] = [];
  private names: readonly string[] = [];

  constructor(private readonly root: HTMLElement) {}

  setDevices(names: readonly string[]): void {
    this.names = names;
    this.cards = names.map((name) => makeCard(name));
    this.root.replaceChildren(...this.cards.map((card) => card.root));
    this.recolour();
  }

  recolour(): void {
    this.cards.forEach((card, i) => {
      card.mark.style.background = seriesColour(i);
    });
  }

  /** The newest state of each device. */
  update(devices: readonly DeviceState[]): void {
    this.cards.forEach((card, i) => {
      const state = devices[i];
      const touching = state?.contactHeard && state.mode !== "none";
      const values = [
        touching ? fixed(1000 * state.depthM, 2) : state?.contactHeard ? "0.00" : "–",
        state?.forceHeard ? fixed(length(state.force), 2) : "–",
        touching ? fixed(state.stiffnessNPerM / 1000, 3) : "–",
        state?.poseHeard || state?.contactHeard ? fixed(state.poseRateHz, 0) : "–",
        state ? fixed(1000 * state.latencyS, 2) : "–",
      ];
      card.numbers.forEach((element, number) => write(element, values[number]));
      write(card.mode, describeMode(state));
      const note = card.difference.update(performance.now(), state, card.state.textContent ?? "");
      write(card.note, note);
      card.note.hidden = note === "";
      card.root.classList.toggle("saturated", state?.saturated ?? false);
    });
  }

  /** What is said about the devices twice a second. */
  setStatus(statuses: readonly DeviceStatus[]): void {
    this.names.forEach((name, i) => {
      const status = statuses.find((one) => one.name === name);
      const { state } = this.cards[i];
      write(state, status ? describe(status) : "not known");
      const bad = status && (!status.alive || status.operating_state === "FAULT");
      state.dataset.level = !status ? "stale" : bad ? "error" : status.operating_state === "ENABLED" ? "ok" : "warn";
    });
  }
}

function describe(status: DeviceStatus): string {
  if (!status.alive) return "silent";
  const parts = [(status.operating_state ?? "state not known").toLowerCase()];
  if (status.busy) parts.push("busy");
  if (status.operating_state === "ENABLED" && !status.homed) parts.push("not homed");
  return parts.join(", ");
}

function describeMode(state: DeviceState | undefined): string {
  if (!state?.contactHeard) return state?.poseHeard ? "no answer from the model" : "";
  if (state.clutched) return "clutched";
  if (state.saturated) return "past a guard";
  return { none: "free", contact: "contact", grasp: "grasp" }[state.mode];
}

function makeCard(name: string): Card {
  const mark = h("i", { class: "mark", "aria-hidden": "true" });
  const [state, mode] = [h("span", { class: "badge" }), h("span", { class: "mode" })];
  const numbers = NUMBERS.map(() => h("dd", {}, "–"));
  const list = h("dl", { class: "numbers" });
  NUMBERS.forEach(([title, unit], i) => {
    list.append(h("div", {}, h("dt", {}, `${title} `, h("span", { class: "unit" }, unit)), numbers[i]));
  });
  const note = h("p", { class: "note" });
  note.hidden = true;
  const head = h("div", { class: "device-head" }, mark, h("h3", {}, name === "" ? "haptic_device" : name), state, mode);
  const root = h("article", { class: "device" }, head, list, note);
  return { root, mark, state, mode, numbers, note, difference: new ForceDifference() };
}
