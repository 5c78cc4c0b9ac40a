// The force on the hand beside the one that the model commands: what the card of a device says when they are not the same.

import type { DeviceState } from "./frames.ts";
import { length, sub } from "./vector.ts";

/** Forces differ noticeably by more than this, N, and this share of the larger one. */
const LEAST_N = 0.1;
const LEAST_SHARE = 0.1;
/** And for longer than this, ms: what is commanded and what is applied are measured one after the other. */
const LASTING_MS = 250;

/** Watches one device. */
export class ForceDifference {
  private sinceMs: number | null = null;

  /** A sentence for the card; empty: nothing is to be said. `operating` is what the driver says of its state. */
  update(nowMs: number, state: DeviceState | undefined, operating: string): string {
    if (!state || !differs(state)) {
      this.sinceMs = null;
      return state?.forceHeard && !state.forceApplied ? "the model's command: no driver says what its motors give" : "";
    }
    this.sinceMs ??= nowMs;
    if (nowMs - this.sinceMs < LASTING_MS) return "";
    const [motors, model] = [length(state.force), length(state.command)].map((force) => force.toFixed(2));
    return `motors ${motors} N, model ${model} N${operating === "" ? "" : `: ${operating}`}`;
  }
}

function differs({ forceHeard, forceApplied, force, commandHeard, command }: DeviceState): boolean {
  if (!forceHeard || !forceApplied || !commandHeard) return false;
  return length(sub(force, command)) > LEAST_N + LEAST_SHARE * Math.max(length(force), length(command));
}
