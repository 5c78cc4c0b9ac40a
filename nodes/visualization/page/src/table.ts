// The plotted window as CSV.

import { QUANTITIES, column } from "./plots.ts";
import type { Series } from "./series.ts";

/** Units as they stand in the names of columns. */
const SUFFIXES: Readonly<Record<string, string>> = {
  depth: "depth_mm",
  force: "force_n",
  rate: "rate_hz",
  latency: "latency_ms",
  missed: "missed_deadlines_per_s",
};

/** Rows between two times of the page, s; the first column is the time of the server's state, s. */
export function csv(series: Series, devices: readonly string[], fromS: number, toS: number, serverColumn: number): string {
  const header = ["time_s", "seconds_before_end"];
  for (const device of devices) {
    for (const { key } of QUANTITIES) header.push(device === "" ? SUFFIXES[key] : `${device}_${SUFFIXES[key]}`);
  }
  const lines = [header.join(",")];
  for (let i = series.firstSince(fromS); i < series.length && series.timeS(i) <= toS; i += 1) {
    const row = [text(series.value(i, serverColumn), 6), (toS - series.timeS(i)).toFixed(4)];
    devices.forEach((_, device) => {
      QUANTITIES.forEach((_quantity, quantity) => row.push(text(series.value(i, column(device, quantity)), 6)));
    });
    lines.push(row.join(","));
  }
  return `${lines.join("\n")}\n`;
}

/** Empty where nothing is known. */
function text(value: number, decimals: number): string {
  return Number.isFinite(value) ? String(Number(value.toFixed(decimals))) : "";
}
