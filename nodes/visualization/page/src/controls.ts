// Mouse, touch and keys on the picture.

import type { OrbitCamera } from "./camera.ts";
import type { Hand, Tool } from "./hand.ts";
import { DEPTHS_M } from "./target.ts";

/** What the keys do besides moving the camera and the hand. */
export interface Commands {
  tool(): Tool;
  chooseColour(index: number): void;
  toggleChains(): void;
  lookBack(byS: number): void;
  live(): void;
  help(): void;
}

type Drag = "orbit" | "pan" | "hand";

/** A turn of the wheel by a notch pulls by this much, m. */
const NOTCH_M = 0.001;
const KEY_TURN_PX = 24;
/** A finger on the body waits for a second one this long, ms, or until it has moved this far, px. */
const FINGER_WAITS_MS = 120;
const FINGER_STAYS_PX = 6;

export class Controls {
  private readonly touches = new Map<number, { x: number; y: number }>();
  private drag: Drag | null = null;
  private keyPress = false;
  /** A finger of which it is not known yet whether it presses or is the first of a pinch. */
  private finger: { readonly at: { x: number; y: number }; readonly timer: ReturnType<typeof setTimeout> } | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly orbit: OrbitCamera,
    private readonly hand: Hand,
    private readonly commands: Commands,
  ) {
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event));
    canvas.addEventListener("pointerleave", () => this.hand.leave());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    document.addEventListener("keydown", (event) => this.keyDown(event));
    document.addEventListener("keyup", (event) => this.keyUp(event));
    canvas.addEventListener("blur", () => this.endKeyPress());
    // A window in the background hears no key that is let go.
    window.addEventListener("blur", () => this.endKeyPress());
  }

  private down(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    const at = place(event);
    this.touches.set(event.pointerId, at);
    if (this.touches.size > 1) {
      this.forgetFinger();
      if (this.drag === "hand") this.hand.end();
      this.drag = this.touches.size === 2 ? "orbit" : "pan";
      return;
    }
    if (event.pointerType === "touch") {
      this.finger = { at, timer: setTimeout(() => this.decideFinger(), FINGER_WAITS_MS) };
      return;
    }
    this.drag = this.dragOf(event, at);
    if (event.button === 1) event.preventDefault();
    this.showCursor();
  }

  private dragOf(event: PointerEvent, at: { x: number; y: number }): Drag {
    if (event.button === 1) return "pan";
    if (event.button === 2) return event.shiftKey ? "pan" : "orbit";
    return this.begins(at.x, at.y, event.shiftKey) ? "hand" : "orbit";
  }

  /** Whether the chosen tool, or with Shift the pull, begins at a place. */
  private begins(x: number, y: number, shift: boolean): boolean {
    const tool = this.commands.tool();
    return tool !== "look" && this.hand.begin(x, y, shift || tool === "pull");
  }

  /** The finger stays alone. */
  private decideFinger(): void {
    const { finger } = this;
    if (!finger) return;
    this.forgetFinger();
    this.drag = this.begins(finger.at.x, finger.at.y, false) ? "hand" : "orbit";
    this.showCursor();
  }

  private forgetFinger(): void {
    clearTimeout(this.finger?.timer);
    this.finger = null;
  }

  private move(event: PointerEvent): void {
    const at = place(event);
    const before = this.touches.get(event.pointerId);
    if (!before) {
      this.hand.hover(at.x, at.y);
      return;
    }
    if (this.touches.size > 1) {
      this.moveTouches(event.pointerId, before, at);
      return;
    }
    if (this.finger) {
      if (Math.hypot(at.x - this.finger.at.x, at.y - this.finger.at.y) < FINGER_STAYS_PX) return;
      this.decideFinger();
    }
    this.touches.set(event.pointerId, at);
    if (this.drag === "hand") this.hand.move(at.x, at.y);
    else if (this.drag === "pan") this.orbit.pan(at.x - before.x, at.y - before.y);
    else if (this.drag === "orbit") this.orbit.orbit(at.x - before.x, at.y - before.y);
  }

  /** Each finger moves everything by its share; two fingers apart come nearer. */
  private moveTouches(id: number, before: { x: number; y: number }, at: { x: number; y: number }): void {
    const count = this.touches.size;
    const [dx, dy] = [(at.x - before.x) / count, (at.y - before.y) / count];
    if (count === 2) {
      const [other] = [...this.touches].filter(([one]) => one !== id).map(([, where]) => where);
      const [then, now] = [Math.hypot(before.x - other.x, before.y - other.y), Math.hypot(at.x - other.x, at.y - other.y)];
      if (then > 0 && now > 0) this.orbit.zoom(then / now);
      this.orbit.orbit(dx, dy);
    } else {
      this.orbit.pan(dx, dy);
    }
    this.touches.set(id, at);
  }

  private up(event: PointerEvent): void {
    this.touches.delete(event.pointerId);
    this.forgetFinger();
    if (this.touches.size > 0) return;
    if (this.drag === "hand") {
      this.hand.end();
      if (event.pointerType === "touch") this.hand.leave();
    }
    this.drag = null;
    this.showCursor();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    // Lines and pages are turned into pixels; a pinch on a touch pad comes as a wheel with Ctrl.
    const pixels = event.deltaY * (event.deltaMode === 0 ? 1 : event.deltaMode === 1 ? 16 : 400);
    const notches = Math.min(Math.max(pixels / 100, -3), 3);
    if (this.hand.pulling) this.hand.nudge(-notches * NOTCH_M);
    else this.orbit.zoom(Math.exp(notches * (event.ctrlKey ? 0.6 : 0.15)));
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const focused = document.activeElement;
    if (focused !== this.canvas && focused !== document.body) return;
    if (this.onKey(event.key, event.shiftKey, event.repeat)) event.preventDefault();
  }

  private onKey(key: string, shift: boolean, repeated: boolean): boolean {
    const arrow = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as const)[key as "ArrowLeft"];
    if (arrow) {
      const [x, y] = arrow;
      if (shift) this.orbit.pan(-x * KEY_TURN_PX, -y * KEY_TURN_PX);
      else this.orbit.orbit(-x * KEY_TURN_PX, -y * KEY_TURN_PX);
      return true;
    }
    const actions: Readonly<Record<string, () => void>> = {
      "+": () => this.orbit.zoom(0.88),
      "=": () => this.orbit.zoom(0.88),
      "-": () => this.orbit.zoom(1 / 0.88),
      r: () => this.orbit.reset(),
      "[": () => this.deeper(-1),
      "]": () => this.deeper(1),
      c: () => this.commands.toggleChains(),
      "1": () => this.commands.chooseColour(0),
      "2": () => this.commands.chooseColour(1),
      "3": () => this.commands.chooseColour(2),
      ",": () => this.commands.lookBack(0.5),
      ".": () => this.commands.lookBack(-0.5),
      l: () => this.commands.live(),
      "?": () => this.commands.help(),
      escape: () => this.hand.release(),
      " ": () => {
        if (!repeated) this.beginKeyPress(shift);
      },
    };
    const action = Object.hasOwn(actions, key.toLowerCase()) ? actions[key.toLowerCase()] : undefined;
    action?.();
    return action !== undefined;
  }

  private deeper(steps: number): void {
    if (this.hand.pulling) this.hand.nudge(steps * NOTCH_M);
    else this.hand.setDepth(this.hand.depthM + steps * DEPTHS_M.step);
  }

  /** Without a mouse: the tool at what is in the middle of the picture. */
  private beginKeyPress(shift: boolean): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.keyPress = this.begins(clientWidth / 2, clientHeight / 2, shift);
  }

  private keyUp(event: KeyboardEvent): void {
    if (event.key === " ") this.endKeyPress();
  }

  private endKeyPress(): void {
    if (!this.keyPress) return;
    this.keyPress = false;
    this.hand.end();
    this.hand.leave();
  }

  private showCursor(): void {
    this.canvas.dataset.drag = this.drag ?? "";
  }
}

function place(event: PointerEvent): { x: number; y: number } {
  return { x: event.offsetX, y: event.offsetY };
}
