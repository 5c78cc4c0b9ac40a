// What a text message from the server says (PROTOCOL.md). Everything is checked here, once; behind this file a message
// is what its type says.

export interface Hello {
  readonly type: "hello";
  readonly protocol: number;
  readonly version: string;
  readonly namespace: string;
  readonly body_frame: string;
  readonly scene_frame: string;
  readonly devices: readonly string[];
  readonly probe_radius_m: number;
  readonly rate_hz: number;
  readonly full_scale_m: number;
  readonly force_scale_m_per_n: number;
  readonly displacement_scale: number;
  readonly boot_id: string;
}

export type Formulation = "energy" | "published";

export interface ChainParameters {
  readonly rod_length_m: number;
  readonly angle_rad: number;
  readonly ratio: number;
  readonly units: number;
  readonly normal_stiffness_n_per_m: number;
  readonly tangential_stiffness_n_per_m: number;
  readonly tangential_growth: number;
  readonly weight: number;
  readonly pitch_m: number;
}

export interface Chains {
  readonly type: "chains";
  readonly formulation: Formulation;
  readonly chains: readonly ChainParameters[];
}

export type ParameterValue = boolean | number | string | readonly (boolean | number | string)[];

export interface Parameter {
  readonly name: string;
  readonly value: ParameterValue;
  readonly type: string;
  readonly unit: string;
  readonly min: number | null;
  readonly max: number | null;
  readonly exclusive_min: boolean;
  readonly help: string;
  readonly accepted: string;
  readonly nodes: readonly string[];
}

export interface Parameters {
  readonly type: "parameters";
  readonly parameters: readonly Parameter[];
}

export interface ParameterResult {
  readonly type: "parameter_result";
  readonly id: number;
  readonly ok: boolean;
  readonly reason: string;
}

export type Level = "ok" | "warn" | "error" | "stale";

export interface NodeStatus {
  readonly name: string;
  readonly level: Level;
  readonly summary: string;
  /** When the node said so, s; null: not known. */
  readonly stamp_s: number | null;
  readonly values: Readonly<Record<string, string>>;
}

export interface DeviceStatus {
  readonly name: string;
  readonly operating_state: string | null;
  readonly homed: boolean;
  readonly busy: boolean;
  readonly pointer: boolean;
  /** A page moves it now. */
  readonly held: boolean;
  /** What the cursor points at is outside its workspace. */
  readonly out_of_reach: boolean;
  readonly pose_age_s: number | null;
  readonly alive: boolean;
  /** A frame of the device that nothing connects to the body; null: none. */
  readonly unplaced_frame: string | null;
}

export interface Status {
  readonly type: "status";
  readonly nodes: readonly NodeStatus[];
  readonly devices: readonly DeviceStatus[];
  readonly publishers: Readonly<Record<string, number>>;
  readonly pages: number;
  readonly not_drawn: Readonly<Record<string, number>>;
}

export interface PointerAnswer {
  readonly type: "pointer";
  readonly device: string;
  readonly granted: boolean;
  readonly reason: string;
}

export interface Refused {
  readonly type: "refused";
  readonly reason: string;
}

export interface Pong {
  readonly type: "pong";
  readonly t: number;
}

export type Message =
  | Hello
  | Chains
  | Parameters
  | ParameterResult
  | Status
  | PointerAnswer
  | Refused
  | Pong;

type Fields = Record<string, unknown>;

/** What a text message says; null: nothing that is known. Never throws. */
export function parse(text: string): Message | null {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    return null;
  }
  if (!isFields(json) || typeof json.type !== "string") return null;
  return Object.hasOwn(readers, json.type) ? readers[json.type](json) : null;
}

const readers: Record<string, (json: Fields) => Message | null> = {
  hello: (json) =>
    json.protocol === 1 && Array.isArray(json.devices)
      ? {
          type: "hello",
          protocol: 1,
          version: text(json.version),
          namespace: text(json.namespace),
          body_frame: text(json.body_frame),
          scene_frame: text(json.scene_frame),
          devices: json.devices.map(text),
          probe_radius_m: positive(json.probe_radius_m, 0.005),
          rate_hz: positive(json.rate_hz, 60),
          full_scale_m: positive(json.full_scale_m, 0.005),
          force_scale_m_per_n: positive(json.force_scale_m_per_n, 0.02),
          displacement_scale: number(json.displacement_scale, 1),
          boot_id: text(json.boot_id),
        }
      : null,
  chains: (json) => {
    const chains = list(json.chains).map(chain);
    const formulation: Formulation = json.formulation === "published" ? "published" : "energy";
    return chains.every((one) => one !== null) ? { type: "chains", formulation, chains } : null;
  },
  parameters: (json) => ({
    type: "parameters",
    parameters: list(json.parameters).map(parameter).filter((one) => one !== null),
  }),
  parameter_result: (json) => ({
    type: "parameter_result",
    id: number(json.id, -1),
    ok: json.ok === true,
    reason: text(json.reason),
  }),
  status: (json) => ({
    type: "status",
    nodes: list(json.nodes).map(node),
    devices: list(json.devices).map(device),
    publishers: counts(json.publishers),
    pages: number(json.pages, 1),
    not_drawn: counts(json.not_drawn),
  }),
  pointer: (json) => ({
    type: "pointer",
    device: text(json.device),
    granted: json.granted === true,
    reason: text(json.reason),
  }),
  refused: (json) => ({ type: "refused", reason: text(json.reason) }),
  pong: (json) => ({ type: "pong", t: number(json.t, 0) }),
};

function chain(json: Fields): ChainParameters | null {
  const read = {
    rod_length_m: number(json.rod_length_m, NaN),
    angle_rad: number(json.angle_rad, NaN),
    ratio: number(json.ratio, NaN),
    units: number(json.units, NaN),
    normal_stiffness_n_per_m: number(json.normal_stiffness_n_per_m, NaN),
    tangential_stiffness_n_per_m: number(json.tangential_stiffness_n_per_m, NaN),
    tangential_growth: number(json.tangential_growth, NaN),
    weight: number(json.weight, 1),
    pitch_m: number(json.pitch_m, NaN),
  };
  const { rod_length_m, angle_rad, ratio, units } = read;
  const possible = rod_length_m > 0 && angle_rad > 0 && angle_rad < Math.PI / 2 && ratio > 0 && ratio < 1 && units >= 1;
  return possible && Object.values(read).every(Number.isFinite) ? read : null;
}

function parameter(json: Fields): Parameter | null {
  const value = json.value;
  const scalar = (one: unknown): boolean => ["boolean", "number", "string"].includes(typeof one);
  if (typeof json.name !== "string" || !(scalar(value) || (Array.isArray(value) && value.every(scalar)))) return null;
  return {
    name: json.name,
    value: value as ParameterValue,
    type: text(json.type),
    unit: text(json.unit),
    min: limit(json.min),
    max: limit(json.max),
    exclusive_min: json.exclusive_min === true,
    help: text(json.help),
    accepted: text(json.accepted),
    nodes: Array.isArray(json.nodes) ? json.nodes.map(text) : [],
  };
}

function node(json: Fields): NodeStatus {
  const values: Record<string, string> = {};
  if (isFields(json.values)) for (const [key, value] of Object.entries(json.values)) values[key] = text(value);
  const levels: readonly Level[] = ["ok", "warn", "error", "stale"];
  const level = levels.find((one) => one === json.level) ?? "stale";
  return { name: text(json.name), level, summary: text(json.summary), stamp_s: limit(json.stamp_s), values };
}

function device(json: Fields): DeviceStatus {
  return {
    name: text(json.name),
    operating_state: typeof json.operating_state === "string" ? json.operating_state : null,
    homed: json.homed === true,
    busy: json.busy === true,
    pointer: json.pointer === true,
    held: json.held === true,
    out_of_reach: json.out_of_reach === true,
    pose_age_s: limit(json.pose_age_s),
    alive: json.alive !== false,
    unplaced_frame: typeof json.unplaced_frame === "string" ? json.unplaced_frame : null,
  };
}

function isFields(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function list(value: unknown): Fields[] {
  return Array.isArray(value) ? value.filter(isFields) : [];
}

function counts(value: unknown): Record<string, number> {
  const found: Record<string, number> = {};
  if (isFields(value)) for (const [key, count] of Object.entries(value)) found[key] = number(count, 0);
  return found;
}

function text(value: unknown): string {
  return typeof value === "string" ? value : value === undefined || value === null ? "" : String(value);
}

function number(value: unknown, otherwise: number): number {
  return typeof value === "number" && Number.isFinite(value) ? value : otherwise;
}

function positive(value: unknown, otherwise: number): number {
  const read = number(value, otherwise);
  return read > 0 ? read : otherwise;
}

function limit(value: unknown): number | null {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}
