// The hand at the mouse: what the user does on the picture becomes targets for a device whose backend is `pointer`.
//
// One page at a time holds a device's pointer; it is asked for with the first press. Targets are repeated while they hold
// (by the socket's thread: the node lets the hand go when they stop), and stop when the cursor leaves the picture.

import type { OrbitCamera } from "./camera.ts";
import type { DeviceState } from "./frames.ts";
import type { Aim } from "./link.ts";
import type { DeviceStatus, PointerAnswer } from "./messages.ts";
import type { Hit, RayTree } from "./raycast.ts";
import { allowedDepth, DEPTHS_M, GRASP_DEPTH_M, hoverTarget, pressTarget, pullTarget } from "./target.ts";
import { add, sub, type Vec3 } from "./vector.ts";

export type Tool = "look" | "press" | "pull";

/** Who holds the pointer of the device. */
export type Hold = "free" | "asked" | "ours" | "refused";

/** What holds, and that the page is alive, is looked after this often, ms. */
const LOOK_AFTER_MS = 33;
/** Targets are sent no more often than this, ms. */
const LEAST_PERIOD_MS = 8;
/** A grasp begins when the probe touches this deep, m, or at last after this time, ms. */
const TOUCH_M = 0.0003;
const GRASP_AFTER_MS = 500;

/** A pointer that nobody uses, or that rests over the body, is given back after this time, for other pages, ms. */
const IDLE_MS = 5000;

/** What the hand needs from the page. */
export interface Surroundings {
  send(message: object): boolean;
  /** Where the hand is wanted until the next call; null: nowhere. */
  aim(aim: Aim | null): void;
  tree(): RayTree | null;
  probeRadiusM(): number;
  device(name: string): DeviceState | null;
  changed(): void;
  /** Whether the picture shows the past. */
  isPast(): boolean;
  /** Show what is. */
  toLive(): void;
}

type Motion =
  | { readonly kind: "away" }
  | { readonly kind: "hover" }
  | { readonly kind: "press"; hit: Hit }
  | { readonly kind: "pull"; readonly hit: Hit; readonly start: Vec3; readonly sinceMs: number; held: boolean; grasped: boolean; nearerM: number };

export class Hand {
  /** Name of the device; null: there is none. */
  device: string | null = null;
  depthM: number = DEPTHS_M.first;
  hold: Hold = "free";
  reason = "";
  /** The device does not go where the cursor is: outside its workspace. */
  outOfReach = false;
  /** The newest target that was sent, m, body frame. */
  target: Vec3 | null = null;
  private motion: Motion = { kind: "away" };
  private sentMs = 0;
  /** When the cursor last moved while nothing is pressed, or let go. */
  private movedMs = 0;

  constructor(
    private readonly orbit: OrbitCamera,
    private readonly around: Surroundings,
  ) {
    setInterval(() => this.lookAfter(), LOOK_AFTER_MS);
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) this.release();
    });
  }

  get active(): boolean {
    return this.motion.kind === "press" || this.motion.kind === "pull";
  }

  get pulling(): boolean {
    return this.motion.kind === "pull";
  }

  /** What the cursor points at, CSS pixels in the picture. */
  pick(x: number, y: number): Hit | null {
    return this.around.tree()?.cast(this.orbit.ray(x, y)) ?? null;
  }

  /** Whether the picture shows the past, by which nobody can lead a device. */
  get past(): boolean {
    return this.around.isPast();
  }

  /** Begin to press, or to grasp, after a picture of the past has given way to the live one; false when there is nothing under the cursor or no such device. */
  begin(x: number, y: number, pull: boolean): boolean {
    const hit = this.device === null ? null : this.pick(x, y);
    if (!hit) return false;
    this.around.toLive();
    this.take();
    if (pull) {
      const start = pressTarget(hit, this.around.probeRadiusM(), GRASP_DEPTH_M);
      this.motion = { kind: "pull", hit, start, sinceMs: performance.now(), held: false, grasped: false, nearerM: 0 };
      this.say(start);
    } else {
      this.motion = { kind: "press", hit };
      this.sayPress(hit);
    }
    this.around.changed();
    return true;
  }

  /** The cursor moved while something is pressed or pulled. */
  move(x: number, y: number): void {
    const { motion } = this;
    if (motion.kind === "press") {
      motion.hit = this.pick(x, y) ?? motion.hit;
      if (this.due()) this.sayPress(motion.hit);
    } else if (motion.kind === "pull" && motion.held) {
      const point = pullTarget(this.orbit.ray(x, y), motion.hit.point, this.orbit.direction(), motion.nearerM);
      if (!point) return;
      this.target = add(motion.start, sub(point, motion.hit.point));
      if (this.due()) this.say(this.target);
    }
  }

  /** The cursor moves over the picture with nothing pressed. */
  hover(x: number, y: number): void {
    if (this.hold !== "ours" || this.active || this.past) return;
    const hit = this.pick(x, y);
    if (!hit) {
      this.stop();
      return;
    }
    this.motion = { kind: "hover" };
    this.movedMs = performance.now();
    if (this.due()) this.say(hoverTarget(hit, this.around.probeRadiusM()));
    else this.target = hoverTarget(hit, this.around.probeRadiusM());
  }

  /** Let go of the surface: hover above it. */
  end(): void {
    const { motion } = this;
    if (motion.kind !== "press" && motion.kind !== "pull") return;
    this.motion = { kind: "hover" };
    this.movedMs = performance.now();
    this.say(hoverTarget(motion.hit, this.around.probeRadiusM()));
    this.around.changed();
  }

  /** Lead the device nowhere until the next press. */
  rest(): void {
    if (this.motion.kind !== "away") this.stop();
  }

  /** The cursor left the picture: targets stop. */
  leave(): void {
    if (!this.active) this.stop();
  }

  /** Pulled in or out, m towards the viewer. */
  nudge(byM: number): void {
    const { motion } = this;
    if (motion.kind !== "pull" || !this.target) return;
    motion.nearerM += byM;
    const direction = this.orbit.direction();
    this.say([0, 1, 2].map((i) => (this.target as Vec3)[i] - byM * direction[i]) as unknown as Vec3);
  }

  setDepth(depthM: number): void {
    this.depthM = allowedDepth(depthM);
    if (this.motion.kind === "press") this.sayPress(this.motion.hit);
    this.around.changed();
  }

  /** Give the pointer back. */
  release(): void {
    this.stop();
    if (this.device !== null && (this.hold === "ours" || this.hold === "asked")) {
      this.around.send({ type: "pointer_release", device: this.device });
    }
    this.hold = "free";
    this.target = null;
    this.around.changed();
  }

  /** What the node says of the devices. */
  onStatus(devices: readonly DeviceStatus[]): void {
    const device = devices.find((one) => one.name === this.device);
    this.outOfReach = device?.out_of_reach ?? false;
    // Whoever had it has let go: what was refused may be asked for again.
    if (this.hold === "refused" && device?.pointer && !device.held) this.hold = "free";
    this.around.changed();
  }

  onAnswer(answer: PointerAnswer): void {
    if (answer.device !== this.device) return;
    this.reason = answer.reason;
    if (answer.granted) this.hold = this.hold === "free" ? "free" : "ours";
    else if (this.hold !== "free") {
      this.hold = "refused";
      this.stop();
      this.target = null;
    }
    this.around.changed();
  }

  /** Nobody holds anything across a connection. */
  onLost(): void {
    this.stop();
    this.hold = "free";
    this.target = null;
    this.around.changed();
  }

  private take(): void {
    if (this.hold === "ours" || this.device === null) return;
    if (this.around.send({ type: "pointer_take", device: this.device })) this.hold = "asked";
  }

  private sayPress(hit: Hit): void {
    this.say(pressTarget(hit, this.around.probeRadiusM(), this.depthM));
  }

  private say(target: Vec3): void {
    this.target = target;
    if (this.device === null || (this.hold !== "ours" && this.hold !== "asked")) return;
    this.sentMs = performance.now();
    const grasp = this.motion.kind === "pull" && this.motion.held;
    this.around.aim({ device: this.device, position: target, grasp });
  }

  private stop(): void {
    this.motion = { kind: "away" };
    this.around.aim(null);
  }

  private lookAfter(): void {
    const { motion } = this;
    if (motion.kind === "away" || !this.target) {
      if (this.hold === "ours" && performance.now() - this.sentMs > IDLE_MS) this.release();
      return;
    }
    if (motion.kind === "hover" && performance.now() - this.movedMs > IDLE_MS) {
      this.release();
      return;
    }
    if (motion.kind === "pull") {
      const state = this.device === null ? null : this.around.device(this.device);
      const { mode, depthM } = state?.contactHeard ? state : { mode: null, depthM: 0 };
      const touches = mode !== null && mode !== "none" && depthM > TOUCH_M;
      motion.held ||= touches || performance.now() - motion.sinceMs > GRASP_AFTER_MS;
      motion.grasped ||= mode === "grasp";
      // It slipped, or somebody let go of it: there is nothing to pull any more.
      if (motion.grasped && mode !== null && mode !== "grasp") this.end();
    }
    this.say(this.target);
  }

  private due(): boolean {
    return performance.now() - this.sentMs >= LEAST_PERIOD_MS;
  }
}
