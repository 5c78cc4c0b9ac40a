// The last 60 s, to look back at: states and surfaces with their times.
//
// Memory is bounded. A surface costs 16 bytes for each moved vertex; when all of them together would cost more than the
// budget, every second one is forgotten and from then on only every second one is kept, and so on. States are small and
// always kept.

import type { StateFrame, SurfaceFrame } from "./frames.ts";

/** How far back the page can look, s. */
export const HISTORY_S = 60;
/** Bytes that surfaces may take. */
const BUDGET_BYTES = 64 * 1024 * 1024;

interface Kept<T> {
  readonly timeS: number;
  readonly frame: T;
}

/** Entries in the order of their times, thrown away when they are too old. */
class Track<T> {
  entries: Kept<T>[] = [];
  private first = 0;

  push(timeS: number, frame: T): void {
    this.entries.push({ timeS, frame });
  }

  /** Forget what is older, except the last one of it: it is what held at that time. */
  forgetBefore(timeS: number, forgotten: (frame: T) => void): void {
    while (this.first + 1 < this.entries.length && this.entries[this.first + 1].timeS <= timeS) {
      forgotten(this.entries[this.first].frame);
      this.first += 1;
    }
    // Moving what is left costs; do it rarely.
    if (this.first > 1024 || this.first > this.entries.length / 2) {
      this.entries = this.entries.slice(this.first);
      this.first = 0;
    }
  }

  /** Keep every second one, the newest in any case. */
  thin(forgotten: (frame: T) => void): void {
    const kept = this.entries.slice(this.first);
    const newest = kept.length - 1;
    this.entries = kept.filter((entry, i) => {
      const keep = (newest - i) % 2 === 0;
      if (!keep) forgotten(entry.frame);
      return keep;
    });
    this.first = 0;
  }

  /** What held at a time: the newest entry that is not later. */
  at(timeS: number): T | null {
    let [low, high] = [this.first, this.entries.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.entries[middle].timeS <= timeS) low = middle + 1;
      else high = middle;
    }
    return low > this.first ? this.entries[low - 1].frame : null;
  }

  get oldestS(): number | null {
    return this.entries.length > this.first ? this.entries[this.first].timeS : null;
  }

  get count(): number {
    return this.entries.length - this.first;
  }

  clear(): void {
    this.entries = [];
    this.first = 0;
  }

  /** The same frames, whatever is pushed and forgotten later. */
  copy(): Track<T> {
    const copy = new Track<T>();
    copy.entries = this.entries.slice(this.first);
    return copy;
  }
}

export class History {
  private surfaces = new Track<SurfaceFrame>();
  private states = new Track<StateFrame>();
  private bytes = 0;
  private stride = 1;
  private skipped = 0;

  constructor(private readonly budgetBytes: number = BUDGET_BYTES) {}

  addState(timeS: number, frame: StateFrame): void {
    this.states.push(timeS, frame);
    this.states.forgetBefore(timeS - HISTORY_S, () => {});
  }

  addSurface(timeS: number, frame: SurfaceFrame): void {
    const forgotten = (old: SurfaceFrame): void => {
      this.bytes -= size(old);
    };
    this.surfaces.forgetBefore(timeS - HISTORY_S, forgotten);
    // With little left to keep, keep more of it again.
    if (this.stride > 1 && this.bytes < this.budgetBytes / 8) this.stride /= 2;
    this.skipped += 1;
    if (this.skipped < this.stride) return;
    this.skipped = 0;
    this.surfaces.push(timeS, frame);
    this.bytes += size(frame);
    while (this.bytes > this.budgetBytes && this.surfaces.count > 1) {
      this.surfaces.thin(forgotten);
      this.stride *= 2;
    }
  }

  surfaceAt(timeS: number): SurfaceFrame | null {
    return this.surfaces.at(timeS);
  }

  stateAt(timeS: number): StateFrame | null {
    return this.states.at(timeS);
  }

  /** The oldest time that can be looked at; null: nothing yet. */
  get oldestS(): number | null {
    return this.states.oldestS ?? this.surfaces.oldestS;
  }

  get surfaceBytes(): number {
    return this.bytes;
  }

  get surfaceCount(): number {
    return this.surfaces.count;
  }

  /** The same, whatever is added to this one later; frames are shared. */
  copy(): History {
    const copy = new History(this.budgetBytes);
    copy.surfaces = this.surfaces.copy();
    copy.states = this.states.copy();
    copy.bytes = this.bytes;
    return copy;
  }

  /** For a new mesh: its vertices are others. */
  clear(): void {
    this.surfaces.clear();
    this.states.clear();
    this.bytes = 0;
    this.stride = 1;
    this.skipped = 0;
  }
}

function size(frame: SurfaceFrame): number {
  return frame.vertices.byteLength + frame.displacements.byteLength;
}
