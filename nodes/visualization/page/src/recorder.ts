// What is kept of the last minute: frames to look back at and the rows behind the plots. While somebody looks back nothing
// is added, so that what he looks at stays.

import { Growth, valueFor } from "./diagnostics.ts";
import type { DeviceState, StateFrame, SurfaceFrame } from "./frames.ts";
import { History } from "./history.ts";
import { length } from "./vector.ts";
import type { Status } from "./messages.ts";
import { APPLIED, column, COMMANDED } from "./plots.ts";
import { Series } from "./series.ts";

export class Recorder {
  readonly history = new History();
  series = new Series(1);
  /** When recording stopped, s of the page; null: it goes on. */
  pausedS: number | null = null;
  devices: readonly string[] = [];
  private growth: Growth[] = [];
  private row = new Float64Array(1);

  /** Begin anew for these devices. */
  setDevices(devices: readonly string[]): void {
    this.devices = devices;
    this.series = new Series(column(devices.length, 0) + 1);
    this.growth = devices.map(() => new Growth());
    this.row = new Float64Array(this.series.columns);
    this.history.clear();
  }

  /** The column of the series with the server's time. */
  get serverColumn(): number {
    return this.series.columns - 1;
  }

  addSurface(timeS: number, surface: SurfaceFrame): void {
    if (this.pausedS === null) this.history.addSurface(timeS, surface);
  }

  addState(timeS: number, state: StateFrame, status: Status | null): void {
    if (this.pausedS !== null) return;
    this.history.addState(timeS, state);
    const { row } = this;
    row.fill(NaN);
    this.devices.forEach((name, device) => {
      const one = state.devices[device];
      const missed = this.growth[device].update(timeS, valueFor(status, name, "missed_deadlines"));
      if (!one) return;
      row[column(device, 0)] = depthMm(one);
      row[column(device, 1)] = one.forceHeard ? length(one.force) : NaN;
      row[column(device, 2)] = one.poseHeard || one.contactHeard ? one.poseRateHz : NaN;
      row[column(device, 3)] = one.contactHeard ? 1000 * one.latencyS : NaN;
      row[column(device, 4)] = missed;
      row[column(device, APPLIED)] = one.forceHeard && one.forceApplied ? length(one.force) : NaN;
      row[column(device, COMMANDED)] = one.commandHeard ? length(one.command) : NaN;
    });
    row[this.serverColumn] = state.serverTimeS;
    this.series.push(timeS, row);
  }
}

function depthMm(state: DeviceState): number {
  if (!state.contactHeard) return NaN;
  return state.mode === "none" ? 0 : 1000 * state.depthM;
}
