// The page's end of the socket's thread.

import type { Vec3 } from "./vector.ts";

/** Where the hand of a pointer device is wanted, m, body frame. */
export interface Aim {
  readonly device: string;
  readonly position: Vec3;
  readonly grasp: boolean;
}

export type ToLink =
  | { readonly type: "open"; readonly url: string; readonly id: number }
  | { readonly type: "close" }
  | { readonly type: "send"; readonly text: string }
  /** Said now and again until the next one; null: no more. */
  | { readonly type: "aim"; readonly aim: Aim | null }
  /** A frame was dealt with. */
  | { readonly type: "taken"; readonly bytes: number };

export type FromLink =
  | { readonly type: "opened"; readonly id: number }
  | { readonly type: "closed"; readonly id: number; readonly code: number; readonly reason: string }
  | { readonly type: "text"; readonly id: number; readonly text: string }
  | { readonly type: "binary"; readonly buffer: ArrayBuffer };

export interface LinkListener {
  opened(): void;
  /** `code`: of the WebSocket's close. */
  closed(code: number, reason: string): void;
  text(text: string): void;
  binary(buffer: ArrayBuffer): void;
}

/** What a browser calls a connection that ended without a farewell. */
const ABNORMAL = 1006;

export class Link {
  private readonly worker = new Worker(new URL("link.js", document.baseURI), { type: "module", name: "link" });
  private id = 0;

  constructor(private readonly listener: LinkListener) {
    this.worker.onmessage = ({ data }: MessageEvent<FromLink>) => this.onMessage(data);
    this.worker.onerror = () => this.listener.closed(ABNORMAL, "the page's own script link.js cannot be run");
  }

  /** A new socket in place of the one before. */
  open(url: string): void {
    this.id += 1;
    this.post({ type: "open", url, id: this.id });
  }

  close(): void {
    this.post({ type: "close" });
  }

  send(text: string): void {
    this.post({ type: "send", text });
  }

  aim(aim: Aim | null): void {
    this.post({ type: "aim", aim });
  }

  private onMessage(message: FromLink): void {
    if (message.type === "binary") {
      const bytes = message.buffer.byteLength;
      this.listener.binary(message.buffer);
      this.post({ type: "taken", bytes });
    } else if (message.id === this.id) {
      // What an older socket still says does not count.
      if (message.type === "opened") this.listener.opened();
      else if (message.type === "closed") this.listener.closed(message.code, message.reason);
      else this.listener.text(message.text);
    }
  }

  private post(message: ToLink): void {
    this.worker.postMessage(message);
  }
}
