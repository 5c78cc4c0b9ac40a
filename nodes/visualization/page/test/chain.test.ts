import assert from "node:assert/strict";
import { test } from "node:test";
import { Chain, ContactLaw, geometricSum, type ChainShape } from "../src/chain.ts";
import type { ChainParameters } from "../src/messages.ts";
import { chainOfRow, displacedContact, Fan, row, rowCount, spring, visibleUnits } from "../src/rhombi.ts";
import { distance, dot, length, sub, type Vec3 } from "../src/vector.ts";

function parameters(a: number, theta: number, k_n: number, k_t: number, q: number, n: number, beta: number): ChainParameters {
  return {
    rod_length_m: a, angle_rad: theta, ratio: q, units: n, normal_stiffness_n_per_m: k_n,
    tangential_stiffness_n_per_m: k_t, tangential_growth: beta, weight: 1, pitch_m: 0.01,
  };
}

function close(found: number, expected: number, relative = 1e-12): void {
  assert.ok(Math.abs(found - expected) <= relative * Math.abs(expected), `${found} is not ${expected}`);
}

const START = { contact: [0.05, -0.02, 0.11] as Vec3, normal: [0.6, 0, 0.8] as Vec3, direction: [0.8, 0, -0.6] as Vec3 };

test("the model's golden values", () => {
  // Elongation, dl_1, d_theta, force by the published and by the energy law (independent evaluation with 50 digits).
  const golden: [ChainParameters, number, number, number, number, number][] = [
    [parameters(0.01, Math.PI / 6, 500, 100, 0.5, 1, 10), -0.002, -0.002, -0.112081929530811, -0.941699475574164, -1.04407105398155],
    [parameters(0.01, Math.PI / 6, 500, 100, 0.8, 12, 10), -0.006, -0.0012885483697159, -0.0729245035346008, -0.604866323792783, -0.406381075179724],
    [parameters(0.006, 0.9, 300, 60, 0.9, 30, 8), 0.008, 0.000835414174496438, 0.1216008449901, 0.160247820117076, 0.275081953369334],
  ];
  for (const [chain, elongation, dl1, dTheta, published, energy] of golden) {
    const shape = new Chain(chain, "energy").atDepth(-elongation);
    close(shape.dl1M, dl1);
    close(shape.angleRad - chain.angle_rad, dTheta, 1e-11);
    close(new Chain(chain, "published").forceN(-elongation), -published, 1e-11);
    close(new Chain(chain, "energy").forceN(-elongation), -energy, 1e-11);
  }
});

test("a law is finite and rises everywhere, far past its guards too", () => {
  for (const formulation of ["energy", "published"] as const) {
    const chain = new Chain(parameters(0.012, 0.8, 230, 14, 0.513, 8, 20), formulation);
    let last = -Infinity;
    for (let step = -400; step <= 400; step += 1) {
      const force = chain.forceN(step * 0.0005);
      assert.ok(Number.isFinite(force) && force > last, `${formulation} at ${step}: ${force} after ${last}`);
      last = force;
      assert.ok(chain.atDepth(step * 0.0005).angleRad > 0 && chain.atDepth(step * 0.0005).angleRad < Math.PI / 2);
    }
    assert.ok(Number.isFinite(chain.forceN(1e9)));
  }
});

test("the rest stiffness is the slope at rest, and parallel chains add up", () => {
  const one = parameters(0.012, 0.8, 230, 14, 0.513, 8, 20);
  const law = new ContactLaw([one, one], "energy");
  close(law.restStiffnessNPerM(), (law.forceN(1e-7) - law.forceN(-1e-7)) / 2e-7, 1e-6);
  close(law.forceN(0.004), 2 * new Chain(one, "energy").forceN(0.004));
});

test("geometric sums of one, a few and very many terms", () => {
  assert.equal(geometricSum(0.5, 1), 1);
  close(geometricSum(0.5, 10), 2 * (1 - 0.5 ** 10));
  close(geometricSum(0.999, 1_000_000), 1000, 1e-9);
  close(geometricSum(1, 1000), 1000);
});

test("every rod keeps its length and every tip is as high as the model has its unit", () => {
  for (const depth of [0.02, 0.006, 1e-5, 0, -0.004]) {
    const shape = new Chain(parameters(0.01, 0.8, 500, 30, 0.8, 12, 10), "energy").atDepth(depth);
    let [rod, height, dl] = [0.01, 0, shape.dl1M];
    for (const { tips, sides, rodM } of row(shape, START)) {
      for (const tip of tips) for (const side of sides) close(distance(tip, side), rod, 1e-10);
      height -= dl;
      assert.ok(Math.abs(dot(sub(tips[1], START.contact), START.normal) - height) < 1e-12);
      assert.equal(rodM, rod);
      rod *= shape.ratio;
      dl *= shape.ratio;
    }
  }
});

test("the units hang together, and the far end is back at the rest surface", () => {
  const shape: ChainShape = new Chain(parameters(0.01, 0.5, 500, 30, 0.5, 40, 10), "energy").atDepth(0.004);
  const rhombi = row(shape, START);
  assert.equal(rhombi.length, 6);
  assert.deepEqual(rhombi[0].tips[0], START.contact);
  for (let i = 1; i < rhombi.length; i += 1) assert.deepEqual(rhombi[i].tips[0], rhombi[i - 1].tips[1]);
  const risen = dot(sub(rhombi[5].tips[1], START.contact), START.normal);
  assert.ok(risen > 0.98 * 0.004 && risen < 0.004, `${risen}`);
});

test("a unit pulled straight gives no NaN", () => {
  const straight = { rodLengthM: 0.01, angleRad: Math.PI / 2, dl1M: 0.001, ratio: 0.9, units: 30 };
  assert.ok(row(straight, START).every(({ tips, sides }) => [...tips, ...sides].flat().every(Number.isFinite)));
});

test("rows: every chain is drawn, the rows stay few, a long chain is cut", () => {
  assert.deepEqual([0, 1, 2, 3, 4, 5, 12, 13].map(rowCount), [0, 4, 4, 6, 4, 5, 12, 12]);
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((i) => chainOfRow(i, 6, 3)), [0, 1, 2, 0, 1, 2]);
  assert.equal(chainOfRow(11, 12, 100), 91);
  assert.deepEqual([visibleUnits(0.999999, 1e6), visibleUnits(0.01, 5), visibleUnits(0.9, 1)], [48, 1, 1]);
});

test("a spring starts and ends at its mass points", () => {
  const corners = spring([0, 0, 0], [1, 0, 0], [0, 1, 0], 3);
  assert.equal(corners.length, 10);
  assert.deepEqual([corners[0], corners[9]], [[0, 0, 0], [1, 0, 0]]);
});

test("the fan follows the surface and does not spin while the contact slides", () => {
  const fan = new Fan();
  let last: Vec3 | null = null;
  for (let step = 0; step <= 200; step += 1) {
    const normal: Vec3 = [Math.sin(step * 0.02), 0, Math.cos(step * 0.02)];
    const directions = fan.directions(normal, 3);
    for (const one of directions) assert.ok(Math.abs(dot(one, normal)) < 1e-12 && Math.abs(length(one) - 1) < 1e-12);
    if (last) assert.ok(distance(directions[0], last) < 0.03, `step ${step}`);
    last = directions[0];
  }
});

test("the contact point moves by exactly the depth, and follows the probe when it is held", () => {
  const touch = { mode: "contact", probe: [0.003, 0, 0.101] as Vec3, proxy: [0, 0, 0.1] as Vec3, normal: [0, 0, 1] as Vec3, depthM: 0.004 };
  assert.deepEqual(displacedContact(touch, 1), [0, 0, 0.1 - 0.004]);
  assert.deepEqual(displacedContact({ ...touch, mode: "grasp" }, 1), [0.003, 0, 0.1 - 0.004]);
});
