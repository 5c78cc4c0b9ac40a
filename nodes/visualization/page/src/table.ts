// The plotted window as CSV.

import { APPLIED, column, COMMANDED } from "./plots.ts";
import type { Series } from "./series.ts";

/** Columns of each device: what is recorded under which name, with its unit. What the plot shows as force is one of the two. */
const COLUMNS: readonly [number, string][] = [
  [0, "depth_mm"],
  [APPLIED, "applied_force_n"],
  [COMMANDED, "commanded_force_n"],
  [2, "rate_hz"],
  [3, "latency_ms"],
  [4, "missed_deadlines_per_s"],
];

/**
 * Rows between two times of the axis, s; the first column is the time of the server's state, s. A row without it and without
 * numbers stands for a time in which nothing was heard.
 */
export function csv(series: Series, devices: readonly string[], fromS: number, toS: number, serverColumn: number): string {
  const header = ["time_s", "seconds_before_end"];
  for (const device of devices) {
    for (const [, name] of COLUMNS) header.push(device === "" ? name : `${device}_${name}`);
  }
  const lines = [header.join(",")];
  for (let i = series.firstSince(fromS); i < series.length && series.timeS(i) <= toS; i += 1) {
    const row = [text(series.value(i, serverColumn), 6), (toS - series.timeS(i)).toFixed(4)];
    devices.forEach((_, device) => {
      for (const [recorded] of COLUMNS) row.push(text(series.value(i, column(device, recorded)), 6));
    });
    lines.push(row.join(","));
  }
  return `${lines.join("\n")}\n`;
}

/** Empty where nothing is known. */
function text(value: number, decimals: number): string {
  return Number.isFinite(value) ? String(Number(value.toFixed(decimals))) : "";
}
