// The parameters that may be changed while everything runs: with unit, range and help, as the nodes describe them.

import { h, newId, write } from "./dom.ts";
import type { Parameter, ParameterResult, ParameterValue } from "./messages.ts";
import { short } from "./nice.ts";

/** Asks the node to set a parameter; returns the number of the request, or null when nobody is connected. */
export type SetParameter = (name: string, value: ParameterValue) => number | null;

interface Row {
  readonly root: HTMLElement;
  readonly inputs: readonly HTMLInputElement[];
  readonly slider: HTMLInputElement | null;
  readonly result: HTMLElement;
  parameter: Parameter;
}

/** A slider asks no more often than this while it is dragged, ms. */
const DRAG_PERIOD_MS = 60;

export class ParametersPanel {
  private readonly rows = new Map<string, Row>();
  private readonly pending = new Map<number, Row>();
  private readonly list = h("div", { class: "parameter-list" });
  private readonly none = h("p", { class: "note" }, "No node has told its parameters yet.");
  private readonly filter: HTMLInputElement;
  private shape = "";

  constructor(
    root: HTMLElement,
    private readonly set: SetParameter,
  ) {
    this.filter = h("input", {
      type: "search",
      placeholder: "Filter by name or help",
      "aria-label": "Filter parameters",
      oninput: () => this.applyFilter(),
    });
    root.append(this.filter, this.none, this.list);
  }

  update(parameters: readonly Parameter[]): void {
    this.none.hidden = parameters.length > 0;
    this.filter.hidden = parameters.length === 0;
    // Rows are made anew only for other parameters, so that nobody loses the field he types in.
    const lengthOf = (value: ParameterValue): number => (Array.isArray(value) ? value.length : -1);
    const shape = JSON.stringify(parameters.map((one) => [one.name, one.type, one.min, one.max, lengthOf(one.value)]));
    if (shape !== this.shape) {
      this.shape = shape;
      this.rebuild(parameters);
    }
    for (const parameter of parameters) {
      const row = this.rows.get(parameter.name);
      if (!row) continue;
      row.parameter = parameter;
      showValue(row);
    }
  }

  onResult(result: ParameterResult): void {
    const row = this.pending.get(result.id);
    if (!row) return;
    this.pending.delete(result.id);
    row.result.dataset.level = result.ok ? "ok" : "error";
    write(row.result, result.ok ? "set" : `refused: ${result.reason}`);
    if (!result.ok) showValue(row, true);
  }

  /** Nobody will answer what was asked before the connection was lost. */
  onLost(): void {
    for (const row of this.pending.values()) {
      row.result.dataset.level = "error";
      write(row.result, "not answered: the connection was lost");
    }
    this.pending.clear();
  }

  private rebuild(parameters: readonly Parameter[]): void {
    this.rows.clear();
    this.pending.clear();
    const groups = new Map<string, HTMLElement>();
    for (const parameter of parameters) {
      const prefix = parameter.name.includes(".") ? parameter.name.slice(0, parameter.name.indexOf(".")) : "";
      let group = groups.get(prefix);
      if (!group) {
        group = h("section", { class: "parameter-group" }, h("h3", {}, prefix === "" ? "other" : prefix));
        groups.set(prefix, group);
      }
      const row = this.makeRow(parameter, parameter.name.slice(prefix === "" ? 0 : prefix.length + 1));
      this.rows.set(parameter.name, row);
      group.append(row.root);
    }
    this.list.replaceChildren(...groups.values());
    this.applyFilter();
  }

  private makeRow(parameter: Parameter, title: string): Row {
    const { value, unit, help, name } = parameter;
    const values = Array.isArray(value) ? value : [value as boolean | number | string];
    const helpId = newId();
    const change = (): void => this.ask(row);
    const inputs = values.map((one, i) => {
      const label = Array.isArray(value) ? `${name}, entry ${i + 1}` : name;
      return makeInput(parameter, one, label, helpId, change);
    });
    const slider = this.makeSlider(parameter, inputs[0], () => this.ask(row));
    const result = h("output", { class: "result", "aria-live": "polite" });
    const head = h("div", { class: "parameter-head" }, h("span", { class: "parameter-name", title: name }, title), result);
    const fields = h("div", { class: "fields" }, slider, ...inputs, unit === "" ? null : h("span", { class: "unit" }, unit));
    const accepted = parameter.accepted === "" ? "" : ` Accepted: ${parameter.accepted}.`;
    const root = h("div", { class: "parameter" }, head, fields, h("p", { class: "note", id: helpId }, help + accepted));
    const row: Row = { root, inputs, slider, result, parameter };
    return row;
  }

  private makeSlider(parameter: Parameter, input: HTMLInputElement, ask: () => void): HTMLInputElement | null {
    const { min, max, value, type } = parameter;
    if (typeof value !== "number" || min === null || max === null || !(max > min)) return null;
    const step = type === "integer" ? 1 : (max - min) / 200;
    const least = parameter.exclusive_min ? min + step : min;
    let waiting: ReturnType<typeof setTimeout> | undefined;
    const slider = h("input", {
      type: "range",
      min: least,
      max,
      step: type === "integer" ? 1 : "any",
      value,
      "aria-label": `${parameter.name}, slider`,
      oninput: () => {
        input.value = String(Number(Number(slider.value).toPrecision(4)));
        waiting ??= setTimeout(() => {
          waiting = undefined;
          ask();
        }, DRAG_PERIOD_MS);
      },
    });
    return slider;
  }

  private ask(row: Row): void {
    const { parameter, inputs, result } = row;
    const read = inputs.map((input) => readInput(parameter, input));
    const wrong = read.findIndex((value) => value === null);
    if (wrong !== -1) {
      result.dataset.level = "error";
      write(result, `“${inputs[wrong].value}” is no ${parameter.type.startsWith("integer") ? "whole number" : "number"}`);
      return;
    }
    const values = read as (boolean | number | string)[];
    const id = this.set(parameter.name, Array.isArray(parameter.value) ? values : values[0]);
    if (id === null) {
      result.dataset.level = "error";
      write(result, "not sent: no connection");
      return;
    }
    result.dataset.level = "";
    write(result, "…");
    this.pending.set(id, row);
  }

  private applyFilter(): void {
    const words = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of this.rows.values()) {
      const text = `${row.parameter.name} ${row.parameter.help}`.toLowerCase();
      row.root.hidden = !words.every((word) => text.includes(word));
    }
    for (const group of this.list.querySelectorAll<HTMLElement>(".parameter-group")) {
      group.hidden = group.querySelector(".parameter:not([hidden])") === null;
    }
  }
}

function makeInput(
  parameter: Parameter,
  value: boolean | number | string,
  label: string,
  helpId: string,
  change: () => void,
): HTMLInputElement {
  const common = { "aria-label": label, "aria-describedby": helpId, onchange: change };
  if (typeof value === "boolean") return h("input", { type: "checkbox", role: "switch", class: "switch", ...common });
  if (typeof value === "string") return h("input", { type: "text", spellcheck: "false", ...common });
  // Text, not number: a browser's number field hides what cannot be read, and the wheel changes it.
  return h("input", { type: "text", inputmode: "decimal", class: "number", title: rangeOf(parameter), ...common });
}

function rangeOf({ accepted, min, max, unit }: Parameter): string {
  if (accepted !== "") return accepted;
  return min !== null || max !== null ? `${short(min)} to ${short(max)} ${unit}` : "";
}

function readInput(parameter: Parameter, input: HTMLInputElement): boolean | number | string | null {
  if (input.type === "checkbox") return input.checked;
  if (parameter.type.startsWith("string")) return input.value;
  const text = input.value.trim().replace("−", "-").replace(",", ".");
  const value = text === "" ? NaN : Number(text);
  const whole = !parameter.type.startsWith("integer") || Number.isInteger(value);
  return Number.isFinite(value) && whole ? value : null;
}

/** Show what holds, except in the field that somebody is typing in. */
function showValue({ parameter, inputs, slider }: Row, always = false): void {
  const { value } = parameter;
  const values = Array.isArray(value) ? value : [value];
  inputs.forEach((input, i) => {
    if (!always && input === document.activeElement && input.type !== "checkbox") return;
    const one: unknown = values[i];
    if (typeof one === "boolean") input.checked = one;
    else input.value = typeof one === "number" ? String(Number(one.toPrecision(12))) : String(one);
  });
  if (slider && typeof value === "number" && slider !== document.activeElement) slider.value = String(value);
}
