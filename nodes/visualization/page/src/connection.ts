// The connection to the node: comes back by itself, with longer and longer pauses, and says what it is doing.

import { type Aim, Link } from "./link.ts";

/** Pauses between attempts, ms. */
const PAUSES_MS = [250, 500, 1000, 2000, 4000, 5000];
/** A node with no room for another page is asked again after these, ms; it says so with this code. */
const FULL_PAUSES_MS = [5000, 10_000, 20_000, 30_000];
const FULL_CODE = 1013;
/** A server sends states at 4 Hz or more; silence for this long means that nobody is there, ms. */
const SILENCE_MS = 700;
const WATCH_MS = 100;
const CONNECT_TIMEOUT_MS = 5000;
/** Without a sign of life for this long the connection is given up and made anew, ms. */
const DEAD_MS = 5000;
const PING_MS = 1000;

export type ConnectionState =
  | { readonly phase: "connecting"; readonly attempt: number }
  | { readonly phase: "connected" }
  /** Connected, but nothing arrives. */
  | { readonly phase: "silent" }
  /** `full`: the node has no room for another page. */
  | { readonly phase: "waiting"; readonly attempt: number; readonly reason: string; readonly full: boolean; readonly untilMs: number };

export interface ConnectionListener {
  onState(state: ConnectionState): void;
  onOpen(): void;
  onText(text: string): void;
  onBinary(buffer: ArrayBuffer): void;
}

/** How often the page lost its node, and the time a message needs there and back. */
export interface ConnectionCounts {
  reconnects: number;
  roundTripMs: number;
}

export class Connection {
  readonly counts: ConnectionCounts = { reconnects: 0, roundTripMs: NaN };
  private readonly link: Link;
  private failures = 0;
  private heardMs = 0;
  private watchedMs = 0;
  private startedMs = 0;
  private opened = false;
  /** The node has said hello: it takes the page. */
  private greeted = false;
  /** Why it does not take the page, in its words. */
  private refusal = "";
  private timer: ReturnType<typeof setTimeout> | undefined;
  private current: ConnectionState = { phase: "connecting", attempt: 1 };

  constructor(
    private readonly url: string,
    private readonly listener: ConnectionListener,
  ) {
    this.link = new Link({
      opened: () => {
        this.opened = true;
        this.heardMs = performance.now();
        this.listener.onOpen();
      },
      closed: (code, reason) => {
        const full = code === FULL_CODE;
        if (this.current.phase !== "waiting") this.lost((full && this.refusal) || reason || "the node does not answer", full);
      },
      text: (text) => {
        this.heard();
        this.listener.onText(text);
      },
      binary: (buffer) => {
        if (!this.opened) return;
        this.heard();
        this.listener.onBinary(buffer);
      },
    });
    setInterval(() => this.watch(), WATCH_MS);
    setInterval(() => this.send({ type: "ping", t: performance.now() }), PING_MS);
    // A network that is back, or a page that is looked at again, need not wait for the pause to end.
    window.addEventListener("online", () => this.retryNow());
    document.addEventListener("visibilitychange", () => {
      if (!document.hidden) this.retryNow();
    });
    this.connect();
  }

  get state(): ConnectionState {
    return this.current;
  }

  /** False when nobody is connected. */
  send(message: object): boolean {
    if (!this.opened) return false;
    this.link.send(JSON.stringify(message));
    return true;
  }

  /** Where the hand is wanted until the next call, or until nobody is connected. */
  aim(aim: Aim | null): void {
    if (this.opened) this.link.aim(aim);
  }

  /** The node takes the page. */
  onHello(): void {
    this.greeted = true;
    this.failures = 0;
    this.heard();
  }

  /** The node refused something; false when that is the page itself, which its close tells. */
  onRefused(reason: string): boolean {
    if (!this.greeted) this.refusal = reason;
    return this.greeted;
  }

  onPong(sentMs: number): void {
    this.counts.roundTripMs = performance.now() - sentMs;
  }

  retryNow(): void {
    if (this.current.phase === "waiting") this.connect();
  }

  private connect(): void {
    clearTimeout(this.timer);
    this.opened = false;
    this.greeted = false;
    this.refusal = "";
    this.startedMs = performance.now();
    this.become({ phase: "connecting", attempt: this.failures + 1 });
    this.link.open(this.url);
  }

  private heard(): void {
    this.heardMs = performance.now();
    if (this.greeted && this.current.phase !== "connected") this.become({ phase: "connected" });
  }

  private lost(reason: string, full: boolean): void {
    if (this.greeted) this.counts.reconnects += 1;
    this.opened = false;
    this.greeted = false;
    const pauses = full ? FULL_PAUSES_MS : PAUSES_MS;
    const pauseMs = pauses[Math.min(this.failures, pauses.length - 1)];
    this.failures += 1;
    this.become({ phase: "waiting", attempt: this.failures, reason, full, untilMs: performance.now() + pauseMs });
    this.timer = setTimeout(() => this.connect(), pauseMs);
  }

  private watch(): void {
    const silentMs = performance.now() - (this.opened ? this.heardMs : this.startedMs);
    const { phase } = this.current;
    // Asked twice: after the page itself was held up, what arrived meanwhile gets its turn first.
    const heardSince = this.watchedMs !== this.heardMs;
    this.watchedMs = this.heardMs;
    if (phase === "connected" && silentMs > SILENCE_MS && !heardSince) this.become({ phase: "silent" });
    const limitMs = phase === "connecting" ? CONNECT_TIMEOUT_MS : DEAD_MS;
    if ((phase === "connecting" || phase === "silent") && silentMs > limitMs) {
      this.lost("nothing was heard from the node", false);
      this.link.close();
    }
  }

  private become(state: ConnectionState): void {
    this.current = state;
    this.listener.onState(state);
  }
}
