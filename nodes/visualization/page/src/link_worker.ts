// The socket, on a thread of its own: drawing without a graphics card holds the page's thread up, and a large update
// needs somebody who takes it off the network all the same.
//
// Frames are handed to the page without a copy. When the page is behind by more than it should be, the newest frame of
// each kind waits here and replaces the one before: memory stays bounded, and the page sees the gap in the numbers.
//
// The other way, where the mouse wants a hand is repeated here: the node lets the hand go when that stops, which a picture
// that takes long to draw is no reason for, and a page that hangs is.

import type { Aim, FromLink, ToLink } from "./link.ts";

/** Frames and bytes that the page may be behind. */
const MOST_FRAMES = 90;
const MOST_BYTES = 24 * 1024 * 1024;
/** Nothing more is sent while so much waits to be sent. */
const MOST_WAITING_BYTES = 65536;
/** An aim that still holds is said again after this time, ms. */
const REPEAT_MS = 33;
/** A page that has not said its aim for this long hangs, ms. Without a graphics card a first picture of something takes a second. */
const MOST_SILENT_MS = 3000;

let socket: WebSocket | null = null;
let frames = 0;
let bytes = 0;
const waiting = new Map<number, ArrayBuffer>();
let aim: Aim | null = null;
let sequence = 0;
let heardMs = 0;
let saidMs = 0;

const post = (message: FromLink, transfer: Transferable[] = []): void => {
  (self as unknown as { postMessage(message: FromLink, transfer: Transferable[]): void }).postMessage(message, transfer);
};

self.onmessage = ({ data }: MessageEvent<ToLink>) => {
  switch (data.type) {
    case "open":
      open(data.url, data.id);
      break;
    case "close":
      socket?.close();
      break;
    case "send":
      send(data.text);
      break;
    case "aim":
      aim = data.aim;
      heardMs = performance.now();
      sayAim();
      break;
    case "taken":
      frames -= 1;
      bytes -= data.bytes;
      deliverWaiting();
      break;
  }
};

setInterval(() => {
  const nowMs = performance.now();
  if (nowMs - heardMs < MOST_SILENT_MS && nowMs - saidMs >= REPEAT_MS - 4) sayAim();
}, REPEAT_MS);

function send(text: string): void {
  if (socket?.readyState === WebSocket.OPEN && socket.bufferedAmount < MOST_WAITING_BYTES) socket.send(text);
}

function sayAim(): void {
  if (!aim) return;
  sequence += 1;
  saidMs = performance.now();
  send(JSON.stringify({ type: "pointer_target", ...aim, sequence }));
}

function open(url: string, id: number): void {
  socket?.close();
  waiting.clear();
  aim = null;
  const opened = new WebSocket(url);
  opened.binaryType = "arraybuffer";
  socket = opened;
  opened.onopen = () => post({ type: "opened", id });
  opened.onclose = (event) => post({ type: "closed", id, code: event.code, reason: event.reason });
  opened.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
    if (socket !== opened) return;
    if (typeof event.data === "string") post({ type: "text", id, text: event.data });
    else receive(event.data);
  };

  function receive(buffer: ArrayBuffer): void {
    const kind = buffer.byteLength > 0 ? new Uint8Array(buffer)[0] : 0;
    waiting.delete(kind);
    waiting.set(kind, buffer);
    deliverWaiting();
  }
}

function deliverWaiting(): void {
  for (const [kind, buffer] of waiting) {
    // A single frame may be larger than all of them should be.
    if (frames > 0 && (frames >= MOST_FRAMES || bytes + buffer.byteLength > MOST_BYTES)) return;
    waiting.delete(kind);
    frames += 1;
    bytes += buffer.byteLength;
    post({ type: "binary", buffer }, [buffer]);
  }
}
