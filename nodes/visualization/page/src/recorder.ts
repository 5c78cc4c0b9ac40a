// What is kept of the last minute: frames to look back at and the rows behind the plots. Recording never stops; somebody who
// looks back looks at a copy of the minute before he began, so that it stays while the next minute is recorded.

import { Clock } from "./clock.ts";
import { Growth } from "./diagnostics.ts";
import type { DeviceState, StateFrame, SurfaceFrame } from "./frames.ts";
import { History } from "./history.ts";
import { length } from "./vector.ts";
import type { Status } from "./messages.ts";
import { APPLIED, column, COMMANDED } from "./plots.ts";
import { Series } from "./series.ts";

/** States come at 4 Hz or more. When none has come for longer than this, s, nothing is known of the time between. */
const SILENCE_S = 0.5;

/** A minute up to `endS`. */
export interface Minute {
  readonly endS: number;
  readonly history: History;
  readonly series: Series;
}

export class Recorder {
  devices: readonly string[] = [];
  private readonly history = new History();
  private series = new Series(1);
  private endS = 0;
  private held: Minute | null = null;
  private clock = new Clock();
  private growth: Growth[] = [];
  private row = new Float64Array(1);

  /** The minute to show: the one that is held, else the one that is recorded. */
  get minute(): Minute {
    return this.held ?? { endS: this.endS, history: this.history, series: this.series };
  }

  /** The column of the series with the server's time. */
  get serverColumn(): number {
    return this.row.length - 1;
  }

  /** Begin anew for these devices. */
  setDevices(devices: readonly string[]): void {
    this.devices = devices;
    this.row = new Float64Array(column(devices.length, 0) + 1);
    this.series = new Series(this.row.length);
    this.growth = devices.map(() => new Growth());
    this.clock = new Clock();
    this.forgetFrames();
  }

  /** Of another body: there is nothing to look back at. The numbers stay. */
  forgetFrames(): void {
    this.history.clear();
    this.held = null;
  }

  /** Keep the minute as it is now, to look at. */
  hold(): void {
    this.held ??= { endS: this.endS, history: this.history.copy(), series: this.series.copy() };
  }

  letGo(): void {
    this.held = null;
  }

  addSurface(arrivalS: number, surface: SurfaceFrame): void {
    this.history.addSurface(this.clock.ofSurface(surface.stampS, arrivalS), surface);
  }

  addState(arrivalS: number, state: StateFrame, status: Status | null): void {
    const timeS = this.clock.ofState(state.serverTimeS, arrivalS);
    this.history.addState(timeS, state);
    const { row } = this;
    row.fill(NaN);
    // No line is drawn over a row without numbers.
    if (this.series.length > 0 && timeS - this.endS > SILENCE_S) this.series.push((this.endS + timeS) / 2, row);
    this.devices.forEach((name, device) => {
      const one = state.devices[device];
      const missed = this.growth[device].of(status, name, "missed_deadlines");
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
    this.endS = timeS;
  }
}

function depthMm(state: DeviceState): number {
  if (!state.contactHeard) return NaN;
  return state.mode === "none" ? 0 : 1000 * state.depthM;
}
