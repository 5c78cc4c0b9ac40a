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

export class RayTree {
  /** Lower and upper corner of each node's box. */
  private readonly boxes: Float32Array;
  /** Inner node: index of its second child (the first follows it), negative. Leaf: its first triangle in `order`. */
  private readonly next: Int32Array;
  private readonly counts: Uint8Array;
  private readonly order: Uint32Array;
  private nodes = 0;

  constructor(
    private readonly positions: Float32Array,
    private readonly corners: Uint32Array,
    private readonly normals: Float32Array,
  ) {
    const triangles = corners.length / 3;
    this.order = Uint32Array.from({ length: triangles }, (_, i) => i);
    const most = 2 * Math.max(Math.ceil(triangles / (LEAF / 2)), 1) + 1;
    this.boxes = new Float32Array(6 * most);
    this.next = new Int32Array(most);
    this.counts = new Uint8Array(most);
    const centres = new Float32Array(corners.length);
    for (let triangle = 0; triangle < triangles; triangle += 1) {
      for (let axis = 0; axis < 3; axis += 1) {
        const at = (corner: number): number => positions[3 * corners[3 * triangle + corner] + axis];
        centres[3 * triangle + axis] = at(0) + at(1) + at(2);
      }
    }
    this.build(0, triangles, centres);
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
        stack.push(-this.next[node], node + 1);
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
  private build(from: number, to: number, centres: Float32Array): number {
    const node = this.nodes;
    this.nodes += 1;
    const axis = this.bound(node, from, to, centres);
    if (to - from <= LEAF) {
      this.next[node] = from;
      this.counts[node] = to - from;
      return node;
    }
    const half = (from + to) >> 1;
    const part = this.order.subarray(from, to);
    part.sort((one, other) => centres[3 * one + axis] - centres[3 * other + axis]);
    this.build(from, half, centres);
    this.next[node] = -this.build(half, to, centres);
    return node;
  }

  /** Writes the node's box; returns the axis along which the centres spread most. */
  private bound(node: number, from: number, to: number, centres: Float32Array): number {
    const box = this.boxes.subarray(6 * node, 6 * node + 6);
    box.fill(Infinity, 0, 3);
    box.fill(-Infinity, 3, 6);
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let i = from; i < to; i += 1) {
      const triangle = this.order[i];
      for (let axis = 0; axis < 3; axis += 1) {
        for (let corner = 0; corner < 3; corner += 1) {
          const value = this.positions[3 * this.corners[3 * triangle + corner] + axis];
          if (value < box[axis]) box[axis] = value;
          if (value > box[3 + axis]) box[3 + axis] = value;
        }
        const centre = centres[3 * triangle + axis];
        low[axis] = Math.min(low[axis], centre);
        high[axis] = Math.max(high[axis], centre);
      }
    }
    const spread = [0, 1, 2].map((axis) => high[axis] - low[axis]);
    return spread.indexOf(Math.max(...spread));
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
