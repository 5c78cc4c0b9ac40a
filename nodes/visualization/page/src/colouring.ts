// The value of each vertex that its colour shows, and the full scale of that colour.

import type { Body } from "./body.ts";
import type { ContactLaw } from "./chain.ts";
import type { Quantity } from "./colours.ts";
import type { DeviceState } from "./frames.ts";
import { niceAbove } from "./nice.ts";
import type { Vec3 } from "./vector.ts";

/** What a colour stands for: in the unit of the legend. */
export interface Scale {
  readonly quantity: Quantity;
  /** "mm", "N", "N/mm" or "" for a factor. */
  readonly unit: string;
  readonly from: number;
  readonly to: number;
  /** One line, and the whole story. */
  readonly note: string;
  readonly explanation: string;
}

/** A contact, as the colour of forces needs it. */
interface Source {
  readonly proxy: Vec3;
  /** Force for each metre of displacement, N/m. */
  readonly newtonPerMetre: number;
}

export class Colouring {
  /** One value for each vertex, as a share of the full scale. */
  readonly shares: Float32Array;
  scale: Scale;
  private largestForceN: number;
  private shownMoved = new Uint32Array(0);
  private shownCount = 0;

  constructor(
    private readonly body: Body,
    private readonly quantity: Quantity,
    private readonly law: ContactLaw | null,
    fullScaleM: number,
  ) {
    this.shares = new Float32Array(body.vertexCount);
    this.shownMoved = new Uint32Array(body.vertexCount);
    const forceN = law ? Math.abs(law.forceN(fullScaleM)) : 0;
    this.largestForceN = niceAbove(forceN > 0 ? forceN : 1);
    this.scale = this.makeScale(fullScaleM);
    if (quantity === "stiffness") this.writeStiffness();
  }

  /** Write the values of what has moved, and of what no longer has; true when the full scale changed. */
  refresh(devices: readonly DeviceState[]): boolean {
    if (this.quantity === "stiffness") return false;
    for (let i = 0; i < this.shownCount; i += 1) this.shares[this.shownMoved[i]] = 0;
    const { moved, movedCount } = this.body;
    this.shownMoved.set(moved.subarray(0, movedCount));
    this.shownCount = movedCount;
    if (this.quantity === "displacement") {
      const perMetre = 1000 / this.scale.to;
      for (let i = 0; i < movedCount; i += 1) {
        this.shares[moved[i]] = perMetre * this.body.displacementOf(moved[i]);
      }
      return false;
    }
    return this.writeForces(devices);
  }

  /** Every unit of a chain under a vertex carries the contact's force in the share of its displacement. */
  private writeForces(devices: readonly DeviceState[]): boolean {
    const touching = devices.filter((one) => one.contactHeard && one.mode !== "none" && one.depthM !== 0);
    const sources = touching.map((one) => source(one));
    const largestN = touching.reduce((largest, one) => Math.max(largest, Math.abs(one.normalForceN) || 0), 0);
    const grown = largestN > this.largestForceN;
    if (grown) {
      this.largestForceN = niceAbove(largestN);
      this.scale = { ...this.scale, to: this.largestForceN };
    }
    const { moved, movedCount, rest } = this.body;
    for (let i = 0; i < movedCount; i += 1) {
      const vertex = moved[i];
      let nearest = Infinity;
      let perMetre = 0;
      for (const { proxy, newtonPerMetre } of sources) {
        const x = rest[3 * vertex] - proxy[0];
        const y = rest[3 * vertex + 1] - proxy[1];
        const z = rest[3 * vertex + 2] - proxy[2];
        const squared = x * x + y * y + z * z;
        if (squared < nearest) {
          nearest = squared;
          perMetre = newtonPerMetre;
        }
      }
      this.shares[vertex] = (perMetre * this.body.displacementOf(vertex)) / this.largestForceN;
    }
    return grown;
  }

  private writeStiffness(): void {
    const { stiffness } = this.body;
    const { from, to } = this.scale;
    if (!stiffness) {
      this.shares.fill(0.5);
      return;
    }
    const unit = this.law ? this.law.restStiffnessNPerM() / 1000 : 1;
    const span = to > from ? 1 / (to - from) : 0;
    for (let vertex = 0; vertex < this.shares.length; vertex += 1) {
      this.shares[vertex] = span === 0 ? 0.5 : (stiffness[vertex] * unit - from) * span;
    }
  }

  private makeScale(fullScaleM: number): Scale {
    switch (this.quantity) {
      case "displacement":
        return {
          quantity: "displacement",
          unit: "mm",
          from: 0,
          to: 1000 * fullScaleM,
          note: "Distance from the place at rest",
          explanation:
            "How far each point of the surface is from its place at rest. Hatched: more than the scale's end " +
            "(visualization.full_scale).",
        };
      case "force":
        return {
          quantity: "force",
          unit: "N",
          from: 0,
          to: this.largestForceN,
          note: "Carried by the chain's unit below",
          explanation:
            "Force carried by the chain's unit under each point: F |u| / |DL| of the nearest contact. Exact for the " +
            "published law, whose units are similar; for the energy law the share by displacement.",
        };
      case "stiffness": {
        const unit = this.law && this.law.chains.length > 0 ? this.law.restStiffnessNPerM() / 1000 : 1;
        const [low, high] = this.body.stiffness ? extremes(this.body.stiffness) : [1, 1];
        return {
          quantity: "stiffness",
          unit: this.law && this.law.chains.length > 0 ? "N/mm" : "× law",
          from: low * unit,
          to: high * unit,
          note: low === high ? "Of the law at rest; no stiffness map" : "Of the law at rest, times the map",
          explanation:
            low === high
              ? "The contact law is the same everywhere: this scene has no stiffness map."
              : "Stiffness at rest: the map's factor times the contact law's.",
        };
      }
    }
  }
}

function source(device: DeviceState): Source {
  const newtonPerMetre = Math.abs(device.normalForceN / device.depthM);
  return { proxy: device.proxy, newtonPerMetre: Number.isFinite(newtonPerMetre) ? newtonPerMetre : 0 };
}

function extremes(values: Float32Array): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}
