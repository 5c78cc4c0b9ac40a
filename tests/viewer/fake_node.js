// A stand-in for the visualization node that says what a test wants it to say, byte by byte from PROTOCOL.md: for what a
// real node must never send, and for the page's own speed. It models nothing: a press is a smooth dent.

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { WebSocketServer } from "ws";

const DIST = join(import.meta.dirname, "../../nodes/visualization/page/dist");
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".txt": "text/plain" };
const RADIUS_M = 0.06;
const DENT_M = 0.02;

export class FakeNode {
  publishers = { body_mesh: 1, surface_displacement: 1, contact_state: 1 };
  /** What the status says of the device, where it is not the usual. */
  device = {};
  /** Messages that the node has not drawn. */
  notDrawn = {};
  /** Whether a page that asks for the pointer gets it; how many gave it back. */
  grants = true;
  released = 0;
  operatingState = "ENABLED";
  pages = new Set();
  /** Numbers of the frames of each kind. */
  sequence = [0, 0, 0, 0];
  topologyVersion = 1;
  /** What pages asked of the pointer: every message of it. */
  pointed = [];
  /** Connections so far, refused ones too. */
  connections = 0;
  #timers = [];

  /**
   * A sphere with about this many vertices. `pointer`: its device follows the mouse; `full`: no page is let in; `bodiless`:
   * no mesh comes.
   */
  constructor({ vertices = 3116, pointer = false, full = false, bodiless = false } = {}) {
    Object.assign(this, { pointer, full, bodiless });
    this.setBody(vertices);
    this.http = createServer((request, response) => serve(request, response));
    this.sockets = new WebSocketServer({ server: this.http, path: "/ws", perMessageDeflate: false });
    this.sockets.on("connection", (socket) => this.#greet(socket));
  }

  /** Starts; port 0 is any free one. */
  async listen(port = 0) {
    await new Promise((resolve) => this.http.listen(port, "127.0.0.1", resolve));
    this.port = this.http.address().port;
    this.url = `http://127.0.0.1:${this.port}/`;
    this.bootId = `${this.port}-${process.hrtime.bigint()}`;
    this.#timers.push(setInterval(() => this.say(this.status()), 400), setInterval(() => this.send(this.state()), 200));
    return this;
  }

  /** Ends as a killed process does. */
  async close() {
    this.quiet();
    for (const socket of this.pages) socket.terminate();
    this.sockets.close();
    this.http.closeAllConnections();
    await new Promise((resolve) => this.http.close(resolve));
  }

  /** Says nothing more, and keeps its connections: a process that hangs. */
  quiet() {
    for (const timer of this.#timers) clearInterval(timer);
    this.#timers = [];
  }

  /** Sends surfaces and states at a rate, one dent after the other. */
  play(rateHz) {
    const dents = Array.from({ length: 40 }, (_, i) => [this.surface(i), this.state(i)]);
    const begun = performance.now();
    let sent = 0;
    this.#timers.push(
      setInterval(() => {
        const due = Math.floor(((performance.now() - begun) / 1000) * rateHz);
        // What a busy machine missed is made up, a few at a time.
        for (let burst = 0; sent < due && burst < 4; burst += 1, sent += 1) {
          for (const buffer of dents[sent % dents.length]) this.send(this.#numbered(buffer));
        }
      }, 1000 / rateHz / 2),
    );
  }

  setBody(vertices) {
    const rings = Math.max(Math.round(Math.sqrt(vertices / 2)), 3);
    [this.xyz, this.corners] = sphere(rings);
  }

  say(message) {
    for (const page of this.pages) page.send(JSON.stringify(message));
  }

  send(buffer) {
    for (const page of this.pages) page.send(buffer);
  }

  /** A copy of a surface or a state as of now. */
  #numbered(buffer) {
    const copy = buffer.slice(0);
    const view = new DataView(copy);
    const kind = view.getUint8(0);
    view.setUint32(4, (this.sequence[kind] += 1), true);
    view.setFloat64(kind === 3 ? 8 : 16, Date.now() / 1000, true);
    return copy;
  }

  #greet(socket) {
    this.connections += 1;
    if (this.full) {
      const reason = "1 pages are open, and more are not served (viewer.max_pages)";
      socket.send(JSON.stringify({ type: "refused", reason }));
      socket.close(1013, "no page is free");
      return;
    }
    this.pages.add(socket);
    socket.on("close", () => this.pages.delete(socket));
    socket.on("message", (data) => {
      const message = JSON.parse(data);
      const answer = (text) => socket.send(JSON.stringify(text));
      if (message.type === "ping") answer({ type: "pong", t: message.t });
      if (message.type.startsWith("pointer_")) this.pointed.push(message);
      if (message.type === "pointer_take") answer({ type: "pointer", device: "", granted: this.grants, reason: this.grants ? "" : "another page moves it" });
      if (message.type === "pointer_release") this.released += 1;
    });
    for (const message of [this.hello(), CHAINS, { type: "parameters", parameters: PARAMETERS }, this.status()]) {
      socket.send(JSON.stringify(message));
    }
    if (!this.bodiless) socket.send(this.mesh());
    socket.send(this.state());
  }

  hello() {
    return {
      type: "hello", protocol: 1, version: "0.1.0", namespace: "/", body_frame: "body", scene_frame: "scene", devices: [""],
      probe_radius_m: 0.005, rate_hz: 60, full_scale_m: 0.005, force_scale_m_per_n: 0.02, displacement_scale: 1, boot_id: this.bootId,
    };
  }

  status() {
    const device = { name: "", operating_state: this.operatingState, homed: true, busy: false, pointer: this.pointer, pose_age_s: 0.001, alive: true, ...this.device };
    const force = { name: "/haptic_device: force", level: "ok", summary: "poses are answered", stamp_s: Math.floor(Date.now() / 1000), values: { missed_deadlines: "0" } };
    const { publishers, pages } = this;
    return { type: "status", nodes: [force], devices: [device], publishers, pages: pages.size, not_drawn: this.notDrawn };
  }

  mesh() {
    const [V, T] = [this.xyz.length / 3, this.corners.length / 3];
    const { buffer, view } = this.#frame(1, 16 + 12 * V + 12 * T);
    [this.topologyVersion, V, T, 0].forEach((value, i) => view.setUint32(8 + 4 * i, value, true));
    new Float32Array(buffer, 24, 3 * V).set(this.xyz);
    new Uint32Array(buffer, 24 + 12 * V, 3 * T).set(this.corners);
    return buffer;
  }

  /** A dent at the top, number `i` of a slow in and out. */
  surface(i) {
    const depth = depthOf(i);
    const moved = [];
    for (let vertex = 0; vertex < this.xyz.length / 3; vertex += 1) {
      const [x, y, z] = this.xyz.subarray(3 * vertex, 3 * vertex + 3);
      const away = Math.hypot(x, y, z - RADIUS_M) / DENT_M;
      if (away < 1) moved.push([vertex, -depth * (1 - away) ** 2]);
    }
    return this.surfaceOf(moved.map(([vertex]) => vertex), moved.flatMap(([, height]) => [0, 0, height]));
  }

  surfaceOf(vertices, xyz, topologyVersion = this.topologyVersion) {
    const N = vertices.length;
    const { buffer, view } = this.#frame(2, 16 + 16 * N);
    view.setUint32(8, topologyVersion, true);
    view.setUint32(12, N, true);
    view.setFloat64(16, Date.now() / 1000, true);
    new Uint32Array(buffer, 24, N).set(vertices);
    new Float32Array(buffer, 24 + 4 * N, 3 * N).set(xyz);
    return buffer;
  }

  /** `applied`: force that the motors give, N; what the model commands if not said. */
  state(i = 0, { probe, applied, serverTimeS = Date.now() / 1000 } = {}) {
    const depth = depthOf(i);
    const { buffer, view } = this.#frame(3, 16 + 128);
    view.setFloat64(8, serverTimeS, true);
    view.setUint32(20, 1, true);
    view.setUint8(24, 1);
    view.setUint8(25, 7 | 32 | 64);
    const at = RADIUS_M - depth + 0.005;
    const numbers = [...(probe ?? [0, 0, at]), 0, 0, 0, 1, 0, 0, RADIUS_M, 0, 0, 1, 0, 0, applied ?? 200 * depth, depth, 200 * depth, 200, 4e-4, 1000, 0, 0, at, 0, 0, 200 * depth];
    numbers.forEach((value, k) => view.setFloat32(24 + 16 + 4 * k, value, true));
    return buffer;
  }

  /** A frame with the next number of its kind. */
  #frame(kind, bytes) {
    const buffer = new ArrayBuffer(8 + bytes);
    const view = new DataView(buffer);
    view.setUint8(0, kind);
    view.setUint32(4, (this.sequence[kind] += 1), true);
    return { buffer, view };
  }
}

const depthOf = (i) => 0.002 + 0.004 * Math.abs(Math.sin((Math.PI * i) / 40));

const CHAINS = {
  type: "chains", device_independent: true, formulation: "energy",
  chains: [[0.012, 0.513, 8, 230], [0.005, 0.801, 23, 580], [0.002, 0.923, 63, 1240]].map(([rod_length_m, ratio, units, normal]) => ({
    rod_length_m, angle_rad: 0.8, ratio, units, normal_stiffness_n_per_m: normal, tangential_stiffness_n_per_m: 0.06 * normal,
    tangential_growth: 20, weight: 1 / 3, pitch_m: 0.002,
  })),
};

const PARAMETERS = [
  {
    name: "visualization.full_scale", value: 0.005, type: "double", unit: "m", min: 0, max: null, exclusive_min: true,
    help: "Displacement that gets the last colour of the scale.", accepted: "> 0", nodes: ["visualization"],
  },
];

function serve(request, response) {
  const path = join(DIST, normalize(request.url === "/" ? "/index.html" : request.url));
  try {
    const body = readFileSync(path);
    response.writeHead(200, {
      "content-type": `${TYPES[extname(path)]}; charset=utf-8`,
      "content-security-policy": `default-src 'self'; connect-src 'self' ws://${request.headers.host}`,
    });
    response.end(body);
  } catch {
    response.writeHead(404).end();
  }
}

/** Vertices and triangles of a sphere. */
function sphere(rings) {
  const sectors = 2 * rings;
  const xyz = [0, 0, RADIUS_M];
  for (let ring = 1; ring < rings; ring += 1) {
    for (let sector = 0; sector < sectors; sector += 1) {
      const [polar, turn] = [(Math.PI * ring) / rings, (2 * Math.PI * sector) / sectors];
      xyz.push(RADIUS_M * Math.sin(polar) * Math.cos(turn), RADIUS_M * Math.sin(polar) * Math.sin(turn), RADIUS_M * Math.cos(polar));
    }
  }
  xyz.push(0, 0, -RADIUS_M);
  const south = xyz.length / 3 - 1;
  const at = (ring, sector) => 1 + (ring - 1) * sectors + (sector % sectors);
  const corners = [];
  for (let sector = 0; sector < sectors; sector += 1) {
    corners.push(0, at(1, sector), at(1, sector + 1));
    for (let ring = 1; ring < rings - 1; ring += 1) {
      corners.push(at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1));
      corners.push(at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1));
    }
    corners.push(south, at(rings - 1, sector + 1), at(rings - 1, sector));
  }
  return [new Float32Array(xyz), new Uint32Array(corners)];
}
