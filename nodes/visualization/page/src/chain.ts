// One chain at a depth: its shape and its force (the model's sections 1 and 2), for drawing and for colours.
//
// All units share the stretch e = dl_i / (2 a_i) = DL / (2 a S_n), so one angle describes the whole chain. Past its
// guards a law continues linearly and the drawn shape stays at the guard's angle.

import type { ChainParameters, Formulation } from "./messages.ts";

/** One chain in its present shape. */
export interface ChainShape {
  /** `a`: rods of the first unit, m. */
  readonly rodLengthM: number;
  /** `theta + d_theta`: between a rod and the tangential diagonal, 0 to pi/2. */
  readonly angleRad: number;
  /** `dl_1`: normal stretch of the first unit, m; negative when pressed. */
  readonly dl1M: number;
  /** `q`. */
  readonly ratio: number;
  /** `n`. */
  readonly units: number;
}

/** Share of the geometrically possible stretch that the law uses. */
const USED_RANGE = 0.98;
/** Energy law, pulled: guarded where the stiffness is this multiple of its rest value. */
const STIFFENING = 10;
/** Published law, pulled: guarded where the stiffness has lost this share of its rest value. */
const SOFTENING = 0.9;

/** `1 + r + .. + r^(n-1)`, by doubling the number of terms: nothing cancels for r near 1. */
export function geometricSum(r: number, n: number): number {
  let sum = 1;
  let power = r;
  for (const digit of n.toString(2).slice(1)) {
    sum += sum * power;
    power *= power;
    if (digit === "1") {
      sum = 1 + r * sum;
      power *= r;
    }
  }
  return sum;
}

/** One chain of a contact law. */
export class Chain {
  private readonly sine: number;
  private readonly cosine: number;
  private readonly tangent: number;
  /** `1 - sin theta`: the largest stretch that geometry allows. */
  private readonly largestStretch: number;
  /** Elongation for a stretch of 1, m. */
  private readonly spanM: number;
  /** `S_n`. */
  readonly elongationSum: number;
  private readonly normal: number;
  private readonly coupling: number;
  private readonly guards: readonly [number, number];

  constructor(
    readonly parameters: ChainParameters,
    private readonly formulation: Formulation,
  ) {
    const { angle_rad, rod_length_m, ratio, units, tangential_growth } = parameters;
    const [k_n, k_t] = [parameters.normal_stiffness_n_per_m, parameters.tangential_stiffness_n_per_m];
    this.sine = Math.sin(angle_rad);
    this.cosine = Math.cos(angle_rad);
    this.tangent = this.sine / this.cosine;
    this.largestStretch = (this.cosine * this.cosine) / (1 + this.sine);
    this.elongationSum = geometricSum(ratio, units);
    this.spanM = 2 * rod_length_m * this.elongationSum;
    const s = this.elongationSum;
    if (formulation === "published") {
      this.normal = (k_n - k_t * this.tangent * this.tangent) / s;
      this.coupling = (k_t * this.tangent) / s;
    } else {
      const tangentialSum = k_t === 0 ? 0 : geometricSum(ratio * ratio * Math.exp(1 / tangential_growth), units);
      this.normal = (k_n * geometricSum(ratio * ratio, units)) / (s * s);
      this.coupling = (k_t * tangentialSum) / (s * s);
    }
    this.guards = [-USED_RANGE * this.sine, this.largestExtension()];
  }

  /** The chain at a depth, positive into the body. */
  atDepth(depthM: number): ChainShape {
    const { rod_length_m, ratio, units } = this.parameters;
    const stretch = Math.min(Math.max(-depthM / this.spanM, this.guards[0]), this.guards[1]);
    const angleRad = Math.asin(Math.min(this.sine + stretch, 1));
    return { rodLengthM: rod_length_m, angleRad, dl1M: -depthM / this.elongationSum, ratio, units };
  }

  /** Force that pushes the probe out at a depth, N; negative when pulled. */
  forceN(depthM: number): number {
    const elongationM = -depthM;
    const stretch = elongationM / this.spanM;
    const guarded = Math.min(Math.max(stretch, this.guards[0]), this.guards[1]);
    const atGuardM = guarded * this.spanM;
    return -(this.closedForm(guarded) + this.stiffness(guarded) * (elongationM - atGuardM));
  }

  /** `dF/dDL` at rest, N/m. */
  restStiffnessNPerM(): number {
    return this.stiffness(0);
  }

  private closedForm(stretch: number): number {
    const { sine, cosine, meanTangent } = this.stretched(stretch);
    const elongationM = stretch * this.spanM;
    return this.formulation === "published"
      ? (this.normal - this.coupling * (meanTangent - this.tangent)) * elongationM
      : (this.normal + (this.coupling * meanTangent * sine) / cosine) * elongationM;
  }

  private stiffness(stretch: number): number {
    const { sine, cosine } = this.stretched(stretch);
    return this.formulation === "published"
      ? this.normal - this.coupling * (sine / cosine - this.tangent)
      : this.normal + (this.coupling * (this.cosine - cosine ** 3)) / cosine ** 3;
  }

  private stretched(stretch: number): { sine: number; cosine: number; meanTangent: number } {
    const sine = this.sine + stretch;
    const cosine = Math.sqrt(Math.max((this.largestStretch - stretch) * (1 + sine), 0));
    return { sine, cosine, meanTangent: (this.sine + sine) / (this.cosine + cosine) };
  }

  private largestExtension(): number {
    const byGeometry = USED_RANGE * this.largestStretch;
    if (this.coupling === 0) return byGeometry;
    const cosine =
      this.formulation === "published"
        ? 1 / Math.hypot(1, this.tangent + (SOFTENING * this.normal) / this.coupling)
        : Math.cbrt((this.coupling * this.cosine) / (this.coupling + this.stiffeningExcess()));
    return Math.min(Math.max(Math.sqrt((1 - cosine) * (1 + cosine)) - this.sine, 0), byGeometry);
  }

  /** From `k + c (cos(theta)/cos^3(x) - 1) = 10 (k + c tan^2(theta))`. */
  private stiffeningExcess(): number {
    return (STIFFENING - 1) * this.normal + STIFFENING * this.coupling * this.tangent * this.tangent;
  }
}

/** Parallel chains on one contact point: same depth, forces add. */
export class ContactLaw {
  readonly chains: readonly Chain[];

  constructor(parameters: readonly ChainParameters[], formulation: Formulation) {
    this.chains = parameters.map((one) => new Chain(one, formulation));
  }

  forceN(depthM: number): number {
    return this.chains.reduce((sum, chain) => sum + chain.forceN(depthM), 0);
  }

  restStiffnessNPerM(): number {
    return this.chains.reduce((sum, chain) => sum + chain.restStiffnessNPerM(), 0);
  }

  shapesAt(depthM: number): ChainShape[] {
    return this.chains.map((chain) => chain.atDepth(depthM));
  }
}
