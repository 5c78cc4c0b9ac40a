// The deformed surface: positions, normals and displacements as typed arrays that are written in place.
//
// An update costs as much as the vertices it moves: their positions are written at once, normals are recomputed for the
// faces around them when a picture is due (`refresh`), and only the blocks of the arrays that changed are uploaded.

import type { MeshFrame, SurfaceFrame } from "./frames.ts";

/** Vertices of one block, the unit of an upload. */
const BLOCK = 128;

/** What became of an update. */
export type Applied = "applied" | "other mesh" | "no such vertex";

/** A piece of the vertex arrays: first vertex and number of vertices. */
export type Range = readonly [number, number];

export class Body {
  readonly vertexCount: number;
  readonly triangleCount: number;
  readonly rest: Float32Array;
  readonly corners: Uint32Array;
  readonly stiffness: Float32Array | null;
  readonly topologyVersion: number;
  /** As drawn: rest plus `displacementScale` times the displacement. */
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly restNormals: Float32Array;
  /** True displacement of each vertex, m; 0 at rest. */
  readonly displacements: Float32Array;
  /** The vertices that an update has moved: the first `movedCount` of them. */
  readonly moved: Uint32Array;
  movedCount = 0;
  /** Displacements that were not finite so far. */
  notFinite = 0;
  /** Grows with every change. */
  revision = 0;
  private displacementScale = 1;

  private readonly faceNormals: Float32Array;
  /** Faces of vertex v: `faces[firstFace[v] .. firstFace[v + 1]]`. */
  private readonly firstFace: Uint32Array;
  private readonly faces: Uint32Array;
  private readonly isMoved: Uint8Array;
  // Work lists with a flag for each entry, so that nothing is in a list twice.
  private readonly changed: Uint32Array;
  private readonly isChanged: Uint8Array;
  private changedCount = 0;
  private readonly touchedFaces: Uint32Array;
  private readonly isTouchedFace: Uint8Array;
  private readonly turned: Uint32Array;
  private readonly isTurned: Uint8Array;
  private readonly dirtyBlocks: Uint8Array;

  constructor(mesh: MeshFrame) {
    const [vertices, triangles] = [mesh.positions.length / 3, mesh.corners.length / 3];
    this.vertexCount = vertices;
    this.triangleCount = triangles;
    this.rest = mesh.positions;
    this.corners = mesh.corners;
    this.stiffness = mesh.stiffness;
    this.topologyVersion = mesh.topologyVersion;
    this.positions = mesh.positions.slice();
    this.normals = new Float32Array(3 * vertices);
    this.displacements = new Float32Array(3 * vertices);
    this.moved = new Uint32Array(vertices);
    this.isMoved = new Uint8Array(vertices);
    this.changed = new Uint32Array(vertices);
    this.isChanged = new Uint8Array(vertices);
    this.touchedFaces = new Uint32Array(triangles);
    this.isTouchedFace = new Uint8Array(triangles);
    this.turned = new Uint32Array(vertices);
    this.isTurned = new Uint8Array(vertices);
    this.dirtyBlocks = new Uint8Array(Math.ceil(vertices / BLOCK));
    this.faceNormals = new Float32Array(3 * triangles);
    [this.firstFace, this.faces] = facesOfVertices(mesh.corners, vertices);
    for (let face = 0; face < triangles; face += 1) this.turnFace(face);
    for (let vertex = 0; vertex < vertices; vertex += 1) this.turnVertex(vertex);
    this.restNormals = this.normals.slice();
  }

  /** Whether a mesh is this body's. */
  isOf(mesh: MeshFrame): boolean {
    const same = (one: ArrayLike<number> | null, other: ArrayLike<number> | null): boolean => {
      if (!one || !other || one.length !== other.length) return one === other;
      for (let i = 0; i < one.length; i += 1) if (one[i] !== other[i]) return false;
      return true;
    };
    return (
      mesh.topologyVersion === this.topologyVersion &&
      same(mesh.positions, this.rest) &&
      same(mesh.corners, this.corners) &&
      same(mesh.stiffness, this.stiffness)
    );
  }

  /** The surface is where the update says, and everything else is at rest. */
  apply(update: SurfaceFrame): Applied {
    if (update.topologyVersion !== this.topologyVersion) return "other mesh";
    const { vertices, displacements } = update;
    for (let i = 0; i < vertices.length; i += 1) if (vertices[i] >= this.vertexCount) return "no such vertex";
    this.toRest();
    for (let i = 0; i < vertices.length; i += 1) {
      const x = displacements[3 * i];
      const y = displacements[3 * i + 1];
      const z = displacements[3 * i + 2];
      if (!Number.isFinite(x + y + z)) {
        this.notFinite += 1;
        continue;
      }
      this.move(vertices[i], x, y, z);
    }
    this.revision += 1;
    return "applied";
  }

  /** No vertex is displaced. */
  toRest(): void {
    for (let i = 0; i < this.movedCount; i += 1) {
      const vertex = this.moved[i];
      this.isMoved[vertex] = 0;
      this.displacements.fill(0, 3 * vertex, 3 * vertex + 3);
      this.place(vertex);
    }
    this.movedCount = 0;
    this.revision += 1;
  }

  /** Draw displacements this many times as large. */
  setDisplacementScale(scale: number): void {
    if (scale === this.displacementScale) return;
    this.displacementScale = scale;
    for (let i = 0; i < this.movedCount; i += 1) this.place(this.moved[i]);
    this.revision += 1;
  }

  /** Recompute the normals around what changed since the last call; returns the pieces to upload. */
  refresh(): Range[] {
    let faceCount = 0;
    for (let i = 0; i < this.changedCount; i += 1) {
      const vertex = this.changed[i];
      this.isChanged[vertex] = 0;
      this.dirtyBlocks[(vertex / BLOCK) | 0] = 1;
      for (let at = this.firstFace[vertex]; at < this.firstFace[vertex + 1]; at += 1) {
        const face = this.faces[at];
        if (this.isTouchedFace[face] === 1) continue;
        this.isTouchedFace[face] = 1;
        this.touchedFaces[faceCount++] = face;
      }
    }
    this.changedCount = 0;
    let turnedCount = 0;
    for (let i = 0; i < faceCount; i += 1) {
      const face = this.touchedFaces[i];
      this.isTouchedFace[face] = 0;
      this.turnFace(face);
      for (let corner = 0; corner < 3; corner += 1) {
        const vertex = this.corners[3 * face + corner];
        if (this.isTurned[vertex] === 1) continue;
        this.isTurned[vertex] = 1;
        this.turned[turnedCount++] = vertex;
      }
    }
    for (let i = 0; i < turnedCount; i += 1) {
      const vertex = this.turned[i];
      this.isTurned[vertex] = 0;
      this.turnVertex(vertex);
      this.dirtyBlocks[(vertex / BLOCK) | 0] = 1;
    }
    return this.takeDirtyRanges();
  }

  /** The displacement of a vertex, m. */
  displacementOf(vertex: number): number {
    const { displacements: u } = this;
    return Math.hypot(u[3 * vertex], u[3 * vertex + 1], u[3 * vertex + 2]);
  }

  private move(vertex: number, x: number, y: number, z: number): void {
    const at = 3 * vertex;
    this.displacements[at] = x;
    this.displacements[at + 1] = y;
    this.displacements[at + 2] = z;
    if (this.isMoved[vertex] === 0) {
      this.isMoved[vertex] = 1;
      this.moved[this.movedCount++] = vertex;
    }
    this.place(vertex);
  }

  private place(vertex: number): void {
    const { rest, displacements, displacementScale, positions } = this;
    for (let at = 3 * vertex; at < 3 * vertex + 3; at += 1) {
      positions[at] = rest[at] + displacementScale * displacements[at];
    }
    if (this.isChanged[vertex] === 1) return;
    this.isChanged[vertex] = 1;
    this.changed[this.changedCount++] = vertex;
  }

  /** Twice the area along the normal, so that large faces count more at their vertices. */
  private turnFace(face: number): void {
    const { positions: p, corners, faceNormals } = this;
    const a = 3 * corners[3 * face];
    const b = 3 * corners[3 * face + 1];
    const c = 3 * corners[3 * face + 2];
    const ux = p[b] - p[a];
    const uy = p[b + 1] - p[a + 1];
    const uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a];
    const vy = p[c + 1] - p[a + 1];
    const vz = p[c + 2] - p[a + 2];
    faceNormals[3 * face] = uy * vz - uz * vy;
    faceNormals[3 * face + 1] = uz * vx - ux * vz;
    faceNormals[3 * face + 2] = ux * vy - uy * vx;
  }

  private turnVertex(vertex: number): void {
    const { faceNormals, faces, normals } = this;
    let x = 0;
    let y = 0;
    let z = 0;
    for (let at = this.firstFace[vertex]; at < this.firstFace[vertex + 1]; at += 1) {
      const face = 3 * faces[at];
      x += faceNormals[face];
      y += faceNormals[face + 1];
      z += faceNormals[face + 2];
    }
    const size = Math.sqrt(x * x + y * y + z * z);
    const shrink = size > 0 ? 1 / size : 0;
    normals[3 * vertex] = x * shrink;
    normals[3 * vertex + 1] = y * shrink;
    normals[3 * vertex + 2] = size > 0 ? z * shrink : 1;
  }

  private takeDirtyRanges(): Range[] {
    const ranges: Range[] = [];
    const blocks = this.dirtyBlocks;
    for (let block = 0; block < blocks.length; block += 1) {
      if (blocks[block] === 0) continue;
      const first = block;
      while (block < blocks.length && blocks[block] === 1) blocks[block++] = 0;
      const from = first * BLOCK;
      ranges.push([from, Math.min(block * BLOCK, this.vertexCount) - from]);
    }
    return ranges;
  }
}

function facesOfVertices(corners: Uint32Array, vertices: number): [Uint32Array, Uint32Array] {
  const first = new Uint32Array(vertices + 1);
  for (let i = 0; i < corners.length; i += 1) first[corners[i] + 1] += 1;
  for (let vertex = 0; vertex < vertices; vertex += 1) first[vertex + 1] += first[vertex];
  const next = first.slice(0, vertices);
  const faces = new Uint32Array(corners.length);
  for (let i = 0; i < corners.length; i += 1) faces[next[corners[i]]++] = (i / 3) | 0;
  return [first, faces];
}
