// What the bytes of a binary frame from the server say (PROTOCOL.md, kinds 1 to 3).
//
// Typed arrays look into the received buffer: nothing is copied, and nothing is allocated for each vertex. They read in
// the byte order of the machine, which is the protocol's on every machine that has a browser.

import { isFinite3, type Vec3 } from "./vector.ts";

/** The body at rest. */
export interface MeshFrame {
  readonly kind: "mesh";
  readonly sequence: number;
  readonly topologyVersion: number;
  /** x, y, z of each vertex, m, body frame. */
  readonly positions: Float32Array;
  /** Three vertices for each triangle. */
  readonly corners: Uint32Array;
  /** Factor on the contact law for each vertex; null: 1 everywhere. */
  readonly stiffness: Float32Array | null;
}

/** Where the surface is now. A vertex that is not listed is at rest. */
export interface SurfaceFrame {
  readonly kind: "surface";
  readonly sequence: number;
  readonly topologyVersion: number;
  readonly stampS: number;
  readonly vertices: Uint32Array;
  /** x, y, z of the displacement of each listed vertex, m. */
  readonly displacements: Float32Array;
}

export type Mode = "none" | "contact" | "grasp";

/** One device. Positions in m, body frame. */
export interface DeviceState {
  readonly mode: Mode;
  readonly contactHeard: boolean;
  readonly forceHeard: boolean;
  /** The force is what the motors apply; otherwise it is the model's command, where nobody says what is applied. */
  readonly forceApplied: boolean;
  readonly commandHeard: boolean;
  readonly poseHeard: boolean;
  readonly saturated: boolean;
  readonly clutched: boolean;
  readonly stampS: number;
  readonly probe: Vec3;
  readonly probeQuaternion: readonly [number, number, number, number];
  /** Contact point on the rest surface. */
  readonly proxy: Vec3;
  /** Out of the body. */
  readonly normal: Vec3;
  /** Force on the hand, N. */
  readonly force: Vec3;
  /** What the model commands, N. */
  readonly command: Vec3;
  /** Positive into the body, m. */
  readonly depthM: number;
  readonly normalForceN: number;
  readonly stiffnessNPerM: number;
  /** NaN: not known. */
  readonly latencyS: number;
  readonly poseRateHz: number;
  readonly handle: Vec3;
}

export interface StateFrame {
  readonly kind: "state";
  readonly sequence: number;
  readonly serverTimeS: number;
  /** Updates that the server dropped for this page so far. */
  readonly dropped: number;
  readonly devices: readonly DeviceState[];
  /** Positions or forces that were not finite and are not shown. */
  readonly notFinite: number;
}

/** A frame that is not what the protocol describes. */
export interface Garbage {
  readonly kind: "garbage";
  readonly reason: string;
}

export type Frame = MeshFrame | SurfaceFrame | StateFrame | Garbage;

const HEADER_BYTES = 8;
const DEVICE_BYTES = 128;
const MODES: readonly Mode[] = ["none", "contact", "grasp"];

/** What a binary frame says; never throws. */
export function decode(buffer: ArrayBuffer): Frame {
  if (buffer.byteLength < HEADER_BYTES) return garbage(`${buffer.byteLength} bytes are no frame`);
  const view = new DataView(buffer);
  const [kind, sequence] = [view.getUint8(0), view.getUint32(4, true)];
  switch (kind) {
    case 1:
      return decodeMesh(view, sequence);
    case 2:
      return decodeSurface(view, sequence);
    case 3:
      return decodeState(view, sequence);
    default:
      return garbage(`no frame of kind ${kind} is known`);
  }
}

function decodeMesh(view: DataView, sequence: number): Frame {
  if (view.byteLength < HEADER_BYTES + 16) return garbage("a mesh frame without its counts");
  const [topologyVersion, vertices, triangles, hasStiffness] = [8, 12, 16, 20].map((at) => view.getUint32(at, true));
  if (hasStiffness > 1) return garbage(`has_stiffness is ${hasStiffness}, not 0 or 1`);
  const expected = HEADER_BYTES + 16 + 12 * vertices + 12 * triangles + 4 * vertices * hasStiffness;
  if (view.byteLength !== expected) return garbage(`a mesh frame of ${view.byteLength} bytes, not ${expected}`);
  let at = HEADER_BYTES + 16;
  const positions = new Float32Array(view.buffer, at, 3 * vertices);
  at += 12 * vertices;
  const corners = new Uint32Array(view.buffer, at, 3 * triangles);
  at += 12 * triangles;
  const stiffness = hasStiffness === 1 ? new Float32Array(view.buffer, at, vertices) : null;
  if (vertices === 0 || triangles === 0) return garbage("a mesh without a triangle");
  if (!allFinite(positions)) return garbage("a mesh with a position that is not finite");
  if (corners.some((vertex) => vertex >= vertices)) return garbage("a triangle with a vertex that does not exist");
  if (stiffness && !stiffness.every((factor) => factor > 0 && Number.isFinite(factor))) {
    return garbage("a stiffness factor that is not above 0 and finite");
  }
  return { kind: "mesh", sequence, topologyVersion, positions, corners, stiffness };
}

function decodeSurface(view: DataView, sequence: number): Frame {
  if (view.byteLength < HEADER_BYTES + 16) return garbage("a surface frame without its counts");
  const [topologyVersion, count] = [view.getUint32(8, true), view.getUint32(12, true)];
  const expected = HEADER_BYTES + 16 + 16 * count;
  if (view.byteLength !== expected) return garbage(`a surface frame of ${view.byteLength} bytes, not ${expected}`);
  const at = HEADER_BYTES + 16;
  return {
    kind: "surface",
    sequence,
    topologyVersion,
    stampS: view.getFloat64(16, true),
    vertices: new Uint32Array(view.buffer, at, count),
    displacements: new Float32Array(view.buffer, at + 4 * count, 3 * count),
  };
}

function decodeState(view: DataView, sequence: number): Frame {
  if (view.byteLength < HEADER_BYTES + 16) return garbage("a state frame without its counts");
  const [dropped, count] = [view.getUint32(16, true), view.getUint32(20, true)];
  const expected = HEADER_BYTES + 16 + DEVICE_BYTES * count;
  if (view.byteLength !== expected) return garbage(`a state frame of ${view.byteLength} bytes, not ${expected}`);
  let notFinite = 0;
  const devices: DeviceState[] = [];
  for (let device = 0; device < count; device += 1) {
    const state = decodeDevice(view, HEADER_BYTES + 16 + DEVICE_BYTES * device);
    if (!state) return garbage("a device in a mode that is not known");
    const checked = withoutNotFinite(state);
    notFinite += checked === state ? 0 : 1;
    devices.push(checked);
  }
  return { kind: "state", sequence, serverTimeS: view.getFloat64(8, true), dropped, devices, notFinite };
}

function decodeDevice(view: DataView, at: number): DeviceState | null {
  const mode = MODES[view.getUint8(at)];
  if (mode === undefined) return null;
  const flags = view.getUint8(at + 1);
  const number = (offset: number): number => view.getFloat32(at + offset, true);
  const vector = (offset: number): Vec3 => [number(offset), number(offset + 4), number(offset + 8)];
  return {
    mode,
    contactHeard: (flags & 1) !== 0,
    forceHeard: (flags & 2) !== 0,
    forceApplied: (flags & 32) !== 0,
    commandHeard: (flags & 64) !== 0,
    poseHeard: (flags & 4) !== 0,
    saturated: (flags & 8) !== 0,
    clutched: (flags & 16) !== 0,
    stampS: view.getFloat64(at + 8, true),
    probe: vector(16),
    probeQuaternion: [number(28), number(32), number(36), number(40)],
    proxy: vector(44),
    normal: vector(56),
    force: vector(68),
    command: vector(112),
    depthM: number(80),
    normalForceN: number(84),
    stiffnessNPerM: number(88),
    latencyS: number(92),
    poseRateHz: number(96),
    handle: vector(100),
  };
}

/** The same state, or one in which what is not finite counts as not heard. */
function withoutNotFinite(state: DeviceState): DeviceState {
  const contact = !state.contactHeard || isFinite3(state.probe);
  const touch =
    !state.contactHeard ||
    state.mode === "none" ||
    (isFinite3(state.proxy) && isFinite3(state.normal) && Number.isFinite(state.depthM));
  const force = !state.forceHeard || isFinite3(state.force);
  const command = !state.commandHeard || isFinite3(state.command);
  const pose = !state.poseHeard || isFinite3(state.handle);
  if (contact && touch && force && command && pose) return state;
  return {
    ...state,
    contactHeard: state.contactHeard && contact && touch,
    mode: contact && touch ? state.mode : "none",
    forceHeard: state.forceHeard && force,
    commandHeard: state.commandHeard && command,
    poseHeard: state.poseHeard && pose,
  };
}

function allFinite(values: Float32Array): boolean {
  for (let i = 0; i < values.length; i += 1) if (!Number.isFinite(values[i])) return false;
  return true;
}

function garbage(reason: string): Garbage {
  return { kind: "garbage", reason };
}
