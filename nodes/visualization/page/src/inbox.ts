// Which binary frames are used: each kind in its order, whole, and known. The others are counted.

import { decode, type Frame, type Garbage } from "./frames.ts";

/** Since the page was opened. */
export interface InboxCounts {
  /** Surface updates that arrived and could be read. */
  surfaces: number;
  states: number;
  meshes: number;
  /** Frames that are missing between two that arrived: dropped by the server for this page. */
  missing: number;
  /** Frames that came after a newer one of their kind, or twice. */
  outOfOrder: number;
  /** Frames that are not what the protocol describes. */
  garbage: number;
  /** Positions and forces that are not finite; they are not drawn. */
  notFinite: number;
  bytes: number;
}

export class Inbox {
  readonly counts: InboxCounts = {
    surfaces: 0,
    states: 0,
    meshes: 0,
    missing: 0,
    outOfOrder: 0,
    garbage: 0,
    notFinite: 0,
    bytes: 0,
  };
  /** Why the last frame was not used. */
  lastReason = "";
  private newest = new Map<string, number>();

  /** A new connection numbers its frames anew. */
  reset(): void {
    this.newest.clear();
  }

  /** The frame, or null when it is not to be used. */
  receive(buffer: ArrayBuffer): Exclude<Frame, Garbage> | null {
    this.counts.bytes += buffer.byteLength;
    const frame = decode(buffer);
    if (frame.kind === "garbage") {
      this.counts.garbage += 1;
      this.lastReason = frame.reason;
      return null;
    }
    const newest = this.newest.get(frame.kind);
    if (newest !== undefined) {
      // Sequence numbers wrap after 2^32.
      const ahead = (frame.sequence - newest) >>> 0;
      if (ahead === 0 || ahead > 0x7fffffff) {
        this.counts.outOfOrder += 1;
        this.lastReason = `a ${frame.kind} frame with number ${frame.sequence} after ${newest}`;
        return null;
      }
      this.counts.missing += ahead - 1;
    }
    this.newest.set(frame.kind, frame.sequence);
    if (frame.kind === "surface") this.counts.surfaces += 1;
    else if (frame.kind === "mesh") this.counts.meshes += 1;
    else {
      this.counts.states += 1;
      this.counts.notFinite += frame.notFinite;
    }
    return frame;
  }
}
