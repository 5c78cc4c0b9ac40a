import assert from "node:assert/strict";
import { test } from "node:test";
import { Body } from "../src/body.ts";
import { Colouring } from "../src/colouring.ts";
import { colourScale, cornersInGamut, STEPS } from "../src/colours.ts";
import { decode, type MeshFrame, type StateFrame, type SurfaceFrame } from "../src/frames.ts";
import { niceAbove, niceBelow, short, fixed } from "../src/nice.ts";
import { RayTree } from "../src/raycast.ts";
import { cross, distance, dot, sub, type Vec3 } from "../src/vector.ts";
import { sphere } from "./sphere.ts";
import { stateFrame, surfaceFrame } from "./bytes.ts";

function surface(version: number, vertices: number[], xyz: number[]): SurfaceFrame {
  return decode(surfaceFrame(1, version, vertices, xyz)) as SurfaceFrame;
}

/** Normals from scratch, as a new body with these positions has them. */
function normalsOf(body: Body): Float32Array {
  const { corners, topologyVersion } = body;
  const mesh: MeshFrame = { kind: "mesh", sequence: 0, topologyVersion, positions: body.positions, corners, stiffness: null };
  return new Body(mesh).normals;
}

test("only what an update lists is displaced, and an update is complete in itself", () => {
  const body = new Body(sphere(12, 3));
  assert.equal(body.apply(surface(3, [5, 9], [0, 0, 0.001, 0.002, 0, 0])), "applied");
  assert.deepEqual([...body.moved.subarray(0, body.movedCount)], [5, 9]);
  assert.equal(body.apply(surface(3, [9], [0, 0.003, 0])), "applied");
  assert.ok(Math.abs(body.displacementOf(9) - 0.003) < 1e-9);
  assert.equal(body.displacementOf(5), 0);
  assert.deepEqual([...body.positions.subarray(15, 18)], [...body.rest.subarray(15, 18)]);
});

test("normals around moved vertices are those of the whole surface computed anew", () => {
  const body = new Body(sphere(16, 1));
  const rounds = [[3, 4, 40], [40, 41], [], [7]];
  for (const vertices of rounds) {
    body.apply(surface(1, vertices, vertices.flatMap((vertex) => [0.01, -0.003 * vertex, 0.02])));
    if (vertices.length === 2) continue; // two updates before one picture
    body.refresh();
    const expected = normalsOf(body);
    for (let i = 0; i < expected.length; i += 1) assert.ok(Math.abs(body.normals[i] - expected[i]) < 1e-6, `${i}`);
  }
});

test("what changed is inside the pieces to upload, and nothing is uploaded twice", () => {
  const body = new Body(sphere(64, 1));
  body.refresh();
  const before = [body.positions.slice(), body.normals.slice()];
  body.apply(surface(1, [2000, 2001], [0.01, 0, 0, 0.01, 0, 0]));
  const ranges = body.refresh();
  const inside = (vertex: number): boolean => ranges.some(([first, count]) => vertex >= first && vertex < first + count);
  for (let i = 0; i < body.positions.length; i += 1) {
    const changed = body.positions[i] !== before[0][i] || body.normals[i] !== before[1][i];
    assert.ok(!changed || inside(Math.floor(i / 3)));
  }
  assert.ok(ranges.reduce((sum, [, count]) => sum + count, 0) < body.vertexCount / 4);
  assert.deepEqual(body.refresh(), []);
});

test("NaN is not drawn and counted; a foreign mesh or vertex changes nothing", () => {
  const body = new Body(sphere(8, 1));
  assert.equal(body.apply(surface(1, [1, 2], [NaN, 0, 0, 0, 0, 0.001])), "applied");
  assert.equal(body.notFinite, 1);
  assert.ok(body.positions.every(Number.isFinite));
  assert.equal(body.apply(surface(2, [1], [0, 0, 1])), "other mesh");
  assert.equal(body.apply(surface(1, [1, 1_000_000], [0, 0, 1, 0, 0, 1])), "no such vertex");
  assert.deepEqual([...body.moved.subarray(0, body.movedCount)], [2]);
});

test("the drawn scale changes positions, not displacements", () => {
  const body = new Body(sphere(8, 1));
  body.apply(surface(1, [2], [0, 0, 0.001]));
  body.setDisplacementScale(10);
  assert.ok(Math.abs(body.positions[8] - body.rest[8] - 0.01) < 1e-6);
  assert.ok(Math.abs(body.displacementOf(2) - 0.001) < 1e-9);
});

test("colours follow displacement, and force in the share of displacement at the nearest contact", () => {
  const body = new Body(sphere(12, 1));
  body.apply(surface(1, [5, 9], [0, 0, -0.002, 0, 0, -0.001]));
  const displacement = new Colouring(body, "displacement", null, 0.004);
  displacement.refresh([]);
  assert.ok(Math.abs(displacement.shares[5] - 0.5) < 1e-6 && displacement.shares[6] === 0);
  const proxy = [...body.rest.subarray(15, 18)];
  const state = decode(stateFrame(1, [{ mode: 1, flags: 7, proxy, depth: 0.002, normalForce: 0.8 }]));
  const { devices } = state as StateFrame;
  const force = new Colouring(body, "force", null, 0.004);
  force.refresh(devices);
  assert.deepEqual([force.scale.to, force.scale.unit], [1, "N"]);
  assert.ok(Math.abs(force.shares[5] - 0.8) < 1e-6 && Math.abs(force.shares[9] - 0.4) < 1e-6);
  body.apply(surface(1, [9], [0, 0, -0.001]));
  force.refresh(devices);
  assert.equal(force.shares[5], 0);
});

test("more is always lighter, on every scale, inside the colours a screen has", () => {
  const linear = (byte: number): number => (byte <= 10.3 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
  for (const quantity of ["displacement", "force", "stiffness"] as const) {
    assert.ok(cornersInGamut(quantity), quantity);
    const colours = colourScale(quantity);
    const luminance = (step: number): number =>
      0.2126 * linear(colours[4 * step]) + 0.7152 * linear(colours[4 * step + 1]) + 0.0722 * linear(colours[4 * step + 2]);
    for (let step = 4; step < STEPS; step += 1) assert.ok(luminance(step) > luminance(step - 4), `${quantity} ${step}`);
    assert.ok(luminance(STEPS - 1) > 10 * luminance(0));
  }
});

test("a ray meets what every triangle asked one by one would say", () => {
  const mesh = sphere(20, 1);
  const body = new Body(mesh);
  const tree = new RayTree(mesh.positions, mesh.corners, body.normals);
  let hits = 0;
  for (let i = 0; i < 200; i += 1) {
    const origin: Vec3 = [0.3 * Math.cos(i), 0.3 * Math.sin(i), 0.2 * Math.sin(3 * i)];
    const to: Vec3 = [0.08 * Math.sin(5 * i), 0.08 * Math.cos(7 * i), 0.08 * Math.sin(2 * i)];
    const size = distance(origin, to);
    const direction = to.map((part, axis) => (part - origin[axis]) / size) as unknown as Vec3;
    const hit = tree.cast({ origin, direction });
    const expected = firstByEveryTriangle(mesh, origin, direction);
    assert.ok(hit ? Math.abs(hit.distanceM - expected) < 1e-6 : expected === Infinity, `ray ${i}: ${hit?.distanceM} not ${expected}`);
    if (!hit) continue;
    hits += 1;
    const outward = hit.normal.reduce((sum, part, axis) => sum + (part * hit.point[axis]) / 0.05, 0);
    assert.ok(outward > 0.97, `${outward}`);
  }
  assert.ok(hits > 20 && hits < 180, `${hits}`);
  // Along an axis, through the middle of boxes' faces.
  assert.ok(tree.cast({ origin: [0.001, 0.0013, 1], direction: [0, 0, -1] }));
  assert.equal(tree.cast({ origin: [0.2, 0, 1], direction: [0, 0, -1] }), null);
});

/** Distance to the nearest triangle: inside all three edges, seen from the ray. */
function firstByEveryTriangle(mesh: MeshFrame, origin: Vec3, direction: Vec3): number {
  let nearest = Infinity;
  const point = (vertex: number): Vec3 => [0, 1, 2].map((axis) => mesh.positions[3 * vertex + axis] - origin[axis]) as unknown as Vec3;
  for (let i = 0; i < mesh.corners.length; i += 3) {
    const [a, b, c] = [point(mesh.corners[i]), point(mesh.corners[i + 1]), point(mesh.corners[i + 2])];
    const sides = [dot(direction, cross(a, b)), dot(direction, cross(b, c)), dot(direction, cross(c, a))];
    if (!(sides.every((side) => side >= 0) || sides.every((side) => side <= 0))) continue;
    const normal = cross(sub(b, a), sub(c, a));
    const distanceM = dot(a, normal) / dot(direction, normal);
    if (distanceM > 0) nearest = Math.min(nearest, distanceM);
  }
  return nearest;
}

test("numbers that people like to read", () => {
  assert.deepEqual([0.35, 1, 1.1, 7, 0.02].map(niceAbove), [0.4, 1, 1.5, 8, 0.02]);
  assert.deepEqual([0.3, 1, 1.9, 7, 49].map(niceBelow), [0.2, 1, 1, 5, 20]);
  assert.deepEqual([short(0.123456), short(-2), short(NaN), short(0), short(1e9)], ["0.123", "−2", "–", "0", "1.00e+9"]);
  assert.deepEqual([fixed(-0.0001, 2), fixed(-1.5, 2), fixed(null, 1)], ["0.00", "−1.50", "–"]);
});
