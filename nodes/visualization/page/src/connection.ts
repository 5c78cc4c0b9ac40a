// The connection to the node: comes back by itself, with longer and longer pauses, and says what it is doing.

/** Pauses between attempts, ms. */
const PAUSES_MS = [250, 500, 1000, 2000, 4000, 5000];
/** A server sends states at 4 Hz or more; silence for this long means that nobody is there, ms. */
const SILENCE_MS = 1000;
const CONNECT_TIMEOUT_MS = 5000;
/** Without a sign of life for this long the connection is given up and made anew, ms. */
const DEAD_MS = 5000;
const PING_MS = 1000;

export type ConnectionState =
  | { readonly phase: "connecting"; readonly attempt: number }
  | { readonly phase: "connected" }
  /** Connected, but nothing arrives. */
  | { readonly phase: "silent" }
  | { readonly phase: "waiting"; readonly attempt: number; readonly reason: string; readonly untilMs: number };

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
  private socket: WebSocket | null = null;
  private failures = 0;
  private heardMs = 0;
  private startedMs = 0;
  private opened = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private current: ConnectionState = { phase: "connecting", attempt: 1 };

  constructor(
    private readonly url: string,
    private readonly listener: ConnectionListener,
  ) {
    setInterval(() => this.watch(), 200);
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

  /** False when nobody is connected, or when more waits to be sent than is worth sending. */
  send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN || this.socket.bufferedAmount > 65536) return false;
    this.socket.send(JSON.stringify(message));
    return true;
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
    this.startedMs = performance.now();
    this.become({ phase: "connecting", attempt: this.failures + 1 });
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.opened = true;
      this.heardMs = performance.now();
      this.listener.onOpen();
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (this.socket !== socket) return;
      this.heardMs = performance.now();
      this.failures = 0;
      if (this.current.phase !== "connected") this.become({ phase: "connected" });
      if (typeof event.data === "string") this.listener.onText(event.data);
      else this.listener.onBinary(event.data);
    };
    socket.onclose = (event) => {
      if (this.socket === socket) this.lost(event.reason || "the node does not answer");
    };
  }

  private lost(reason: string): void {
    if (this.opened) this.counts.reconnects += 1;
    this.socket = null;
    const pauseMs = PAUSES_MS[Math.min(this.failures, PAUSES_MS.length - 1)];
    this.failures += 1;
    this.become({ phase: "waiting", attempt: this.failures, reason, untilMs: performance.now() + pauseMs });
    this.timer = setTimeout(() => this.connect(), pauseMs);
  }

  private watch(): void {
    const silentMs = performance.now() - (this.opened ? this.heardMs : this.startedMs);
    const { phase } = this.current;
    if (phase === "connected" && silentMs > SILENCE_MS) this.become({ phase: "silent" });
    const limitMs = phase === "connecting" ? CONNECT_TIMEOUT_MS : DEAD_MS;
    if ((phase === "connecting" || phase === "silent") && silentMs > limitMs) {
      const socket = this.socket;
      this.lost("nothing was heard from the node");
      socket?.close();
    }
  }

  private become(state: ConnectionState): void {
    this.current = state;
    this.listener.onState(state);
  }
}
