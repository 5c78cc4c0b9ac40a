// Where a ray meets the body at rest: what the cursor points at.
//
// A tree of boxes over the triangles, built once for each mesh, so that pointing costs the same on 3000 vertices and on
// 200 000. The rest surface is asked, not the drawn one: depth is measured from it.

import { add, dot, normalized, scale, sub, cross, type Vec3 } from "./vector.ts";

export interface Ray {
  readonly origin: Vec3;
  /** Unit vector. */
  readonly direction: Vec3;
}

export interface Hit {
  readonly point: Vec3;
  /** Out of the body, interpolated between the vertices; a unit vector. */
  readonly normal: Vec3;
  readonly distanceM: number;
}

/** Triangles that a leaf holds. */
const LEAF = 8;
/** Bits of a position along each axis in the order of the triangles, and of a triangle's number. */
const GRID_BITS = 10;
const NUMBER_BITS = 22;

export class RayTree {
  /** Lower and upper corner of each node's box. */
  private readonly boxes: Float32Array;
  /** Inner node: index of its second child (the first follows it). Leaf: its first triangle in `order`. */
  private readonly next: Uint32Array;
  /** Triangles of a leaf; 0 is an inner node. */
  private readonly counts: Uint8Array;
  private readonly order: Uint32Array;
  private nodes = 0;

  constructor(
    private readonly positions: Float32Array,
    private readonly corners: Uint32Array,
    private readonly normals: Float32Array,
  ) {
    this.order = alongCurve(positions, corners);
    const most = 4 * Math.ceil(this.order.length / LEAF) + 1;
    this.boxes = new Float32Array(6 * most);
    this.next = new Uint32Array(most);
    this.counts = new Uint8Array(most);
    this.build(0, this.order.length);
  }

  /** The first triangle that the ray meets from outside or inside; null: none. */
  cast(ray: Ray): Hit | null {
    const inverse = ray.direction.map((part) => 1 / part);
    const stack = [0];
    let best = Infinity;
    let found: { triangle: number; u: number; v: number } | null = null;
    while (stack.length > 0) {
      const node = stack.pop() as number;
      if (this.enters(node, ray.origin, inverse) >= best) continue;
      const count = this.counts[node];
      if (count === 0) {
        stack.push(this.next[node], node + 1);
        continue;
      }
      for (let i = this.next[node]; i < this.next[node] + count; i += 1) {
        const meets = this.meets(this.order[i], ray);
        if (meets && meets[0] < best) {
          best = meets[0];
          found = { triangle: this.order[i], u: meets[1], v: meets[2] };
        }
      }
    }
    if (!found) return null;
    const { triangle, u, v } = found;
    const [a, b, c] = [0, 1, 2].map((corner) => this.vector(this.normals, this.corners[3 * triangle + corner]));
    const normal = add(scale(a, 1 - u - v), add(scale(b, u), scale(c, v)));
    const facing = scale(ray.direction, -1);
    return {
      point: add(ray.origin, scale(ray.direction, best)),
      normal: normalized(normal, facing),
      distanceM: best,
    };
  }

  /** Builds the node over `order[from .. to]`; returns its index. */
  private build(from: number, to: number): number {
    const node = this.nodes;
    this.nodes += 1;
    if (to - from <= LEAF) {
      this.next[node] = from;
      this.counts[node] = to - from;
      this.boundTriangles(node, from, to);
      return node;
    }
    const half = (from + to) >> 1;
    const first = this.build(from, half);
    const second = this.build(half, to);
    this.next[node] = second;
    const { boxes } = this;
    for (let i = 0; i < 3; i += 1) {
      boxes[6 * node + i] = Math.min(boxes[6 * first + i], boxes[6 * second + i]);
      boxes[6 * node + 3 + i] = Math.max(boxes[6 * first + 3 + i], boxes[6 * second + 3 + i]);
    }
    return node;
  }

  private boundTriangles(node: number, from: number, to: number): void {
    const { boxes, positions, corners, order } = this;
    boxes.fill(Infinity, 6 * node, 6 * node + 3);
    boxes.fill(-Infinity, 6 * node + 3, 6 * node + 6);
    for (let i = from; i < to; i += 1) {
      for (let corner = 3 * order[i]; corner < 3 * order[i] + 3; corner += 1) {
        for (let axis = 0; axis < 3; axis += 1) {
          const value = positions[3 * corners[corner] + axis];
          boxes[6 * node + axis] = Math.min(boxes[6 * node + axis], value);
          boxes[6 * node + 3 + axis] = Math.max(boxes[6 * node + 3 + axis], value);
        }
      }
    }
  }

  /** Distance at which the ray enters a node's box; infinity when it does not. */
  private enters(node: number, origin: Vec3, inverse: readonly number[]): number {
    let [near, far] = [0, Infinity];
    for (let axis = 0; axis < 3; axis += 1) {
      const low = (this.boxes[6 * node + axis] - origin[axis]) * inverse[axis];
      const high = (this.boxes[6 * node + 3 + axis] - origin[axis]) * inverse[axis];
      // A ray in the plane of a face gives NaN, which must not decide.
      near = Math.max(near, Math.min(low, high) || 0);
      far = Math.min(far, Number.isNaN(low + high) ? Infinity : Math.max(low, high));
    }
    return near <= far * (1 + 1e-6) ? near : Infinity;
  }

  /** Distance and barycentric coordinates (Moeller and Trumbore 1997). */
  private meets(triangle: number, ray: Ray): [number, number, number] | null {
    const [a, b, c] = [0, 1, 2].map((corner) => this.vector(this.positions, this.corners[3 * triangle + corner]));
    const [ab, ac] = [sub(b, a), sub(c, a)];
    const p = cross(ray.direction, ac);
    const determinant = dot(ab, p);
    if (determinant === 0) return null;
    const from = sub(ray.origin, a);
    const u = dot(from, p) / determinant;
    if (u < 0 || u > 1) return null;
    const q = cross(from, ab);
    const v = dot(ray.direction, q) / determinant;
    if (v < 0 || u + v > 1) return null;
    const distance = dot(ac, q) / determinant;
    return distance > 0 ? [distance, u, v] : null;
  }

  private vector(of: Float32Array, vertex: number): Vec3 {
    return [of[3 * vertex], of[3 * vertex + 1], of[3 * vertex + 2]];
  }
}

/** The triangles in the order of a curve that fills space (Morton): neighbours on it are neighbours in the body. */
function alongCurve(positions: Float32Array, corners: Uint32Array): Uint32Array {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < positions.length; i += 1) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const cells = 2 ** GRID_BITS - 1;
  // Place on the curve and number of the triangle in one number, which a typed array sorts quickly.
  const keys = new Float64Array(corners.length / 3);
  for (let triangle = 0; triangle < keys.length; triangle += 1) {
    let place = 0;
    for (let axis = 0; axis < 3; axis += 1) {
      let sum = 0;
      for (let corner = 3 * triangle; corner < 3 * triangle + 3; corner += 1) sum += positions[3 * corners[corner] + axis];
      const share = (sum / 3 - low[axis]) / (high[axis] - low[axis]);
      place |= spread(Math.min(Math.max(Math.round(share * cells), 0), cells)) << axis;
    }
    keys[triangle] = place * 2 ** NUMBER_BITS + triangle;
  }
  keys.sort();
  return Uint32Array.from(keys, (key) => key % 2 ** NUMBER_BITS);
}

/** The bits of a number below 1024, two apart. */
function spread(value: number): number {
  let bits = value;
  bits = (bits | (bits << 16)) & 0x030000ff;
  bits = (bits | (bits << 8)) & 0x0300f00f;
  bits = (bits | (bits << 4)) & 0x030c30c3;
  return (bits | (bits << 2)) & 0x09249249;
}
