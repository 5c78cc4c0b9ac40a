// What the page knows, and what it does with each thing that arrives.

import { Body } from "./body.ts";
import { ContactLaw } from "./chain.ts";
import { Connection, type ConnectionState } from "./connection.ts";
import { missingPublishers, silentDevices } from "./diagnostics.ts";
import type { MeshFrame, StateFrame, SurfaceFrame } from "./frames.ts";
import { Hand } from "./hand.ts";
import { Inbox } from "./inbox.ts";
import { parse, type Chains, type Hello, type Message, type Parameter, type ParameterValue, type Status } from "./messages.ts";
import type { Notices } from "./notices.ts";
import { RayTree } from "./raycast.ts";
import { Recorder, type Minute } from "./recorder.ts";
import type { Look, Stage } from "./stage.ts";

/** The parts of the page that show what the app knows. */
export interface Views {
  hello(hello: Hello): void;
  chains(): void;
  connection(state: ConnectionState): void;
  state(state: Pick<StateFrame, "devices">): void;
  status(status: Status): void;
  parameters(parameters: readonly Parameter[]): void;
  result(result: { id: number; ok: boolean; reason: string; type: "parameter_result" }): void;
  lost(): void;
  body(body: Body): void;
  hand(): void;
  recorded(minute: Minute): void;
  /** Leave the past. */
  live(): void;
}

/** A refusal stays on the page for this long, ms. */
const REFUSAL_MS = 6000;
/** So does that the page went to live by itself, ms. */
const TO_LIVE_MS = 6000;

/** Time of the page, s. */
export const nowS = (): number => performance.now() / 1000;

export class App {
  readonly inbox = new Inbox();
  readonly recorder = new Recorder();
  readonly connection: Connection;
  readonly hand: Hand;
  hello: Hello | null = null;
  chains: Chains | null = null;
  parameters: readonly Parameter[] = [];
  status: Status | null = null;
  state: StateFrame | null = null;
  body: Body | null = null;
  /** Surface updates written to the surface; updates for another mesh or another number of vertices. */
  applied = 0;
  otherMesh = 0;
  /** Messages that the node refused. */
  refusals = 0;
  firstPictureMs: number | null = null;
  /** How far back the picture is, s; 0: live. */
  lookingBackS = 0;
  private newest: SurfaceFrame | null = null;
  private tree: RayTree | null = null;
  private requests = 0;

  constructor(
    readonly stage: Stage,
    readonly notices: Notices,
    private readonly views: Views,
  ) {
    this.hand = new Hand(stage.orbit, {
      send: (message) => this.connection.send(message),
      aim: (aim) => this.connection.aim(aim),
      tree: () => this.rayTree(),
      probeRadiusM: () => this.number("probe.radius") ?? this.hello?.probe_radius_m ?? 0.005,
      device: (name) => this.state?.devices[this.hello?.devices.indexOf(name) ?? -1] ?? null,
      changed: () => this.views.hand(),
      isPast: () => this.lookingBackS > 0,
      toLive: () => {
        if (this.lookingBackS === 0) return;
        this.views.live();
        this.notices.set("live", "Back to live: a press is felt now.", TO_LIVE_MS);
      },
    });
    stage.onPicture = () => {
      if (this.body) this.firstPictureMs ??= performance.now();
    };
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.connection = new Connection(`${scheme}://${location.host}/ws`, {
      onState: (state) => this.onConnection(state),
      onOpen: () => this.inbox.reset(),
      onText: (text) => this.onText(text),
      onBinary: (buffer) => this.onBinary(buffer),
    });
  }

  /** Ask the node to set a parameter; null: nobody is connected. */
  setParameter(name: string, value: ParameterValue): number | null {
    this.requests += 1;
    return this.connection.send({ type: "set_parameter", id: this.requests, name, value }) ? this.requests : null;
  }

  /** Show what was some seconds ago; 0: what is. */
  lookBack(agoS: number): void {
    const { recorder } = this;
    this.lookingBackS = agoS;
    if (agoS === 0) {
      recorder.letGo();
      this.showLive();
    } else {
      // Nobody leads a device by a picture of the past.
      this.hand.rest();
      recorder.hold();
      const { endS, history } = recorder.minute;
      const surface = history.surfaceAt(endS - agoS);
      if (surface) this.body?.apply(surface);
      else this.body?.toRest();
      const state = history.stateAt(endS - agoS);
      this.stage.setDevices(state?.devices ?? []);
      if (state) this.views.state(state);
    }
    this.views.hand();
    this.stage.invalidate();
  }

  private showLive(): void {
    if (this.newest) this.showSurface(this.newest);
    else this.body?.toRest();
    const { phase } = this.connection.state;
    if (phase === "connected" && this.state) this.showState(this.state);
    else this.showNoDevices();
  }

  /** What is old must not look like what is. */
  private showNoDevices(): void {
    this.stage.setDevices([]);
    this.views.state({ devices: [] });
  }

  private onConnection(state: ConnectionState): void {
    this.views.connection(state);
    if ((state.phase === "waiting" || state.phase === "silent") && this.lookingBackS === 0) this.showNoDevices();
    if (state.phase === "waiting") {
      this.hand.onLost();
      this.views.lost();
    }
  }

  private onText(text: string): void {
    const message = parse(text);
    if (message) this.onMessage(message);
    else this.inbox.counts.garbage += 1;
  }

  private onMessage(message: Message): void {
    switch (message.type) {
      case "hello":
        this.onHello(message);
        break;
      case "chains":
        this.chains = message;
        this.stage.setLaw(message.chains.length > 0 ? new ContactLaw(message.chains, message.formulation) : null);
        this.views.chains();
        break;
      case "parameters":
        this.parameters = message.parameters;
        this.applyLook();
        this.views.parameters(message.parameters);
        break;
      case "parameter_result":
        this.views.result(message);
        break;
      case "status":
        this.onStatus(message);
        break;
      case "pointer":
        this.hand.onAnswer(message);
        break;
      case "refused":
        this.refusals += 1;
        if (this.connection.onRefused(message.reason)) this.notices.set("refused", `Refused: ${message.reason}`, REFUSAL_MS);
        break;
      case "pong":
        this.connection.onPong(message.t);
        break;
    }
  }

  private onHello(hello: Hello): void {
    const known = this.hello;
    this.hello = hello;
    this.connection.onHello();
    if (known?.devices.join() !== hello.devices.join()) {
      this.recorder.setDevices(hello.devices);
      this.leavePast();
    }
    // Of another start of the node: what was true then need not be.
    if (known?.boot_id !== hello.boot_id) this.state = null;
    this.applyLook();
    this.views.hello(hello);
  }

  private onStatus(status: Status): void {
    this.status = status;
    const missing = [...missingPublishers(status.publishers), ...silentDevices(status.devices)];
    this.notices.set("publishers", missing.length > 0 ? missing.join(" ") : null);
    const faults = status.devices.filter((device) => device.operating_state === "FAULT").map((device) => device.name || "the device");
    this.notices.set("fault", faults.length > 0 ? `FAULT: ${faults.join(", ")} gives no force until it is enabled again.` : null);
    const unplaced = status.devices.filter((device) => device.unplaced_frame !== null).map((device) => device.unplaced_frame);
    this.notices.set("frames", unplaced.length > 0 ? `Not drawn: nothing connects ${unplaced.join(", ")} to the body's frame.` : null);
    this.hand.onStatus(status.devices);
    this.views.status(status);
  }

  private onBinary(buffer: ArrayBuffer): void {
    const frame = this.inbox.receive(buffer);
    switch (frame?.kind) {
      case "mesh":
        this.onMesh(frame);
        break;
      case "surface":
        this.onSurface(frame);
        break;
      case "state":
        this.onState(frame);
        break;
    }
  }

  private onMesh(frame: MeshFrame): void {
    this.newest = null;
    // The same body again, after a loss: what is known of it still holds.
    if (this.body?.isOf(frame)) {
      if (this.lookingBackS === 0) this.showLive();
      return;
    }
    this.body = new Body(frame);
    this.tree = null;
    this.recorder.forgetFrames();
    this.leavePast();
    this.stage.setBody(this.body);
    this.views.body(this.body);
  }

  private leavePast(): void {
    if (this.lookingBackS > 0) this.views.live();
  }

  private onSurface(frame: SurfaceFrame): void {
    if (frame.topologyVersion !== this.body?.topologyVersion) {
      this.otherMesh += 1;
      return;
    }
    if (this.lookingBackS > 0) this.newest = frame;
    else this.showSurface(frame);
    this.recorder.addSurface(nowS(), frame);
  }

  private showSurface(frame: SurfaceFrame): void {
    this.newest = frame;
    if (this.body?.apply(frame) === "applied") this.applied += 1;
    else this.otherMesh += 1;
    this.stage.invalidate();
  }

  private onState(frame: StateFrame): void {
    this.state = frame;
    this.recorder.addState(nowS(), frame, this.status);
    if (this.lookingBackS > 0) return;
    this.showState(frame);
    this.views.recorded(this.recorder.minute);
  }

  private showState(frame: StateFrame): void {
    this.stage.setDevices(frame.devices);
    this.views.state(frame);
  }

  /** Where the look is also a parameter of the node, the parameter's value counts: it may have been changed since hello. */
  private applyLook(): void {
    const { hello } = this;
    if (!hello) return;
    const look: Partial<Look> = {
      fullScaleM: this.number("visualization.full_scale") ?? hello.full_scale_m,
      forceScaleMPerN: this.number("visualization.force_scale") ?? hello.force_scale_m_per_n,
      displacementScale: this.number("visualization.displacement_scale") ?? hello.displacement_scale,
      probeRadiusM: this.number("probe.radius") ?? hello.probe_radius_m,
    };
    this.stage.setLook(look);
  }

  private number(name: string): number | null {
    const value = this.parameters.find((one) => one.name === name)?.value;
    return typeof value === "number" ? value : null;
  }

  private rayTree(): RayTree | null {
    const { body } = this;
    if (body) this.tree ??= new RayTree(body.rest, body.corners, body.restNormals);
    return this.tree;
  }
}
