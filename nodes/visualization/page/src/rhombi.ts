// Where the rods, mass points and springs of a chain are while it is stretched: the same picture as in RViz
// (src/rhombi.rs and src/drawing/chains.rs of this node).
//
// The units hang together tip to tip along their tangential diagonals, in a row that leaves the contact along the
// surface. All units have the same shape, so the row is a straight line, inclined such that its height above the
// contact after i units is dl_1 + .. + dl_i: the tip at the contact is moved by the whole depth, the far end not at all.

import type { ChainShape } from "./chain.ts";
import { add, cross, distance, dot, length, lerp, normalized, reject, scale, sub, type Vec3 } from "./vector.ts";

/** Units beyond which the movement is less than this share of the depth are not drawn. */
const VISIBLE_SHARE = 0.02;
/** A row is never longer than this many units. */
const MAX_UNITS = 48;
/** A contact is surrounded by at least this many rows of units, and by no more than the other number. */
const FEWEST_ROWS = 4;
const MOST_ROWS = 12;

/** Where a row of units starts and where it goes. */
export interface RowStart {
  /** The displaced contact point. */
  readonly contact: Vec3;
  /** Unit vector out of the body. */
  readonly normal: Vec3;
  /** Unit vector along the surface, perpendicular to `normal`. */
  readonly direction: Vec3;
}

/** The mass points of one unit. Rods join each tip with each side; the springs are the two diagonals. */
export interface Rhombus {
  /** Tip towards the contact, and the one away from it: ends of the tangential diagonal. */
  readonly tips: readonly [Vec3, Vec3];
  /** Ends of the normal diagonal: into the body, out of it. */
  readonly sides: readonly [Vec3, Vec3];
  readonly rodM: number;
}

/** The units that move visibly, from the contact on. */
export function row(chain: ChainShape, start: RowStart): Rhombus[] {
  const [sine, cosine] = [Math.sin(chain.angleRad), Math.cos(chain.angleRad)];
  // Height gained for each length of a tangential diagonal. A unit pulled nearly straight is higher than it is long, and
  // then no inclination is enough: the row points straight down and its far end leaves the rest surface.
  const wanted = -chain.dl1M / (2 * chain.rodLengthM * cosine);
  const slope = Math.min(Math.max(Number.isFinite(wanted) ? wanted : Math.sign(-chain.dl1M), -1), 1);
  const level = Math.sqrt((1 - slope) * (1 + slope));
  const along = add(scale(start.direction, level), scale(start.normal, slope));
  const across = sub(scale(start.normal, level), scale(start.direction, slope));
  const rhombi: Rhombus[] = [];
  let near = start.contact;
  let rodM = chain.rodLengthM;
  for (let unit = visibleUnits(chain.ratio, chain.units); unit > 0; unit -= 1) {
    const middle = add(near, scale(along, rodM * cosine));
    const far = add(near, scale(along, 2 * rodM * cosine));
    const side = scale(across, rodM * sine);
    rhombi.push({ tips: [near, far], sides: [sub(middle, side), add(middle, side)], rodM });
    near = far;
    rodM *= chain.ratio;
  }
  return rhombi;
}

/**
 * Number of units whose inner tip moves by a visible share of the depth: (q^i - q^n) / (1 - q^n) of it after i units. It
 * does not depend on the depth, so nothing pops up while pressing.
 */
export function visibleUnits(ratio: number, units: number): number {
  const end = ratio ** units;
  const longest = Math.min(units, MAX_UNITS);
  for (let i = 1; i < longest; i += 1) if (ratio ** i - end < VISIBLE_SHARE * (1 - end)) return i;
  return longest;
}

/** Number of rows around a contact: every chain as often as every other, unless there are too many to draw. */
export function rowCount(chains: number): number {
  if (chains === 0) return 0;
  return chains <= MOST_ROWS ? chains * Math.ceil(FEWEST_ROWS / chains) : MOST_ROWS;
}

/** The chain that row `i` of `count` shows: neighbouring rows show different chains. */
export function chainOfRow(i: number, count: number, chains: number): number {
  return count >= chains ? i % chains : Math.floor((i * chains) / count);
}

/** A spring as a zigzag: the corners from one end to the other, both included, in the plane of `aside`. */
export function spring(from: Vec3, to: Vec3, aside: Vec3, turns: number): Vec3[] {
  // Straight piece at each end, and width to each side, as shares of the length.
  const [STRAIGHT, WIDTH] = [0.15, 0.06];
  const widthM = WIDTH * distance(from, to);
  const corners: Vec3[] = [from, lerp(from, to, STRAIGHT)];
  for (let corner = 0; corner < 2 * turns; corner += 1) {
    const along = STRAIGHT + ((1 - 2 * STRAIGHT) * (corner + 0.5)) / (2 * turns);
    corners.push(add(lerp(from, to, along), scale(aside, corner % 2 === 0 ? widthM : -widthM)));
  }
  corners.push(lerp(from, to, 1 - STRAIGHT), to);
  return corners;
}

/**
 * Directions in which the rows of a contact leave it: a fan around the normal that turns with the contact as little as
 * possible, so that the picture does not spin while the probe slides.
 */
export class Fan {
  private first: Vec3 = [1, 0, 0];

  /** Follow the contact: `count` unit vectors perpendicular to the unit vector `normal`, equally spaced. */
  directions(normal: Vec3, count: number): Vec3[] {
    const references: Vec3[] = [this.first, [1, 0, 0], [0, 1, 0]];
    const tangent = references
      .map((reference) => reject(reference, normal))
      .find((one) => dot(one, one) > 0.01);
    this.first = normalized(tangent ?? [0, 0, 1], [0, 0, 1]);
    const second = cross(normal, this.first);
    return Array.from({ length: count }, (_, i) => {
      const angle = (2 * Math.PI * i) / count;
      return add(scale(this.first, Math.cos(angle)), scale(second, Math.sin(angle)));
    });
  }
}

/** Where the contact point of a touch is now; a grasped one also follows the probe along the surface. */
export function displacedContact(
  touch: { mode: string; probe: Vec3; proxy: Vec3; normal: Vec3; depthM: number },
  displacementScale: number,
): Vec3 {
  const lateral = touch.mode === "grasp" ? reject(sub(touch.probe, touch.proxy), touch.normal) : ([0, 0, 0] as Vec3);
  return add(touch.proxy, scale(sub(lateral, scale(touch.normal, touch.depthM)), displacementScale));
}

/** Whether a normal can be drawn along. */
export const isUnit = (normal: Vec3): boolean => Math.abs(length(normal) - 1) < 1e-2;
