import assert from "node:assert/strict";
import { test } from "node:test";
import { Growth, missingPublishers, valueFor } from "../src/diagnostics.ts";
import { decode, type StateFrame, type SurfaceFrame } from "../src/frames.ts";
import { History, HISTORY_S } from "../src/history.ts";
import { parse, type Status } from "../src/messages.ts";
import { Series } from "../src/series.ts";
import { allowedDepth, hoverTarget, pressTarget, pullTarget } from "../src/target.ts";
import { stateFrame, surfaceFrame } from "./bytes.ts";

const surface = (sequence: number, moved: number): SurfaceFrame =>
  decode(surfaceFrame(sequence, 1, Array(moved).fill(0), Array(3 * moved).fill(0))) as SurfaceFrame;

test("looking back shows what held at that time, for 60 s and not longer", () => {
  const history = new History();
  for (let i = 0; i <= 1000; i += 1) {
    history.addState(i * 0.1, decode(stateFrame(i, [])) as StateFrame);
    history.addSurface(i * 0.1, surface(i, 2));
  }
  assert.equal(history.stateAt(99.95)?.sequence, 999);
  assert.equal(history.surfaceAt(70)?.sequence, 700);
  assert.ok(Math.abs((history.oldestS ?? 0) - (100 - HISTORY_S)) < 0.11);
  assert.equal(history.stateAt(1), null);
  assert.ok(history.surfaceCount <= 602);
});

test("large surfaces are thinned out and stay inside the budget, and the newest is always there", () => {
  const history = new History(100_000);
  for (let i = 0; i < 3600; i += 1) history.addSurface(i / 60, surface(i, 100));
  assert.ok(history.surfaceBytes <= 100_000);
  assert.ok(history.surfaceCount > 20, `${history.surfaceCount}`);
  // Over the whole minute, not only its end.
  assert.ok(history.surfaceAt(10) !== null);
  assert.ok((history.surfaceAt(60)?.sequence ?? 0) > 3400);
});

test("one surface larger than the budget is still kept", () => {
  const history = new History(100);
  for (let i = 0; i < 10; i += 1) history.addSurface(i, surface(i, 1000));
  assert.equal(history.surfaceCount, 1);
});

test("a ring keeps the newest rows in order", () => {
  const series = new Series(2, 5);
  for (let i = 0; i < 8; i += 1) series.push(i, [10 * i, i === 6 ? NaN : -i]);
  assert.equal(series.length, 5);
  assert.deepEqual(series.times(0, 5), [3, 4, 5, 6, 7]);
  assert.deepEqual(series.column(1, 0, 5), [-3, -4, -5, null, -7]);
  assert.deepEqual([series.firstSince(4.5), series.firstSince(0), series.firstSince(99)], [2, 0, 5]);
});

test("targets: pressed by the depth, hovering above, pulled in the plane of the screen", () => {
  const hit = { point: [0, 0, 0.1], normal: [0, 0, 1], distanceM: 1 } as const;
  assert.deepEqual(pressTarget(hit, 0.005, 0.006).map((x) => Math.round(x * 1e6)), [0, 0, 99000]);
  assert.deepEqual(hoverTarget(hit, 0.005).map((x) => Math.round(x * 1e6)), [0, 0, 115000]);
  const ray = { origin: [0, 0, 1], direction: [0.6, 0, -0.8] } as const;
  const pulled = pullTarget(ray, [0, 0, 0.2], [0, 0, -1], 0.01);
  assert.deepEqual(pulled?.map((x) => Math.round(x * 1e6)), [600000, 0, 210000]);
  assert.equal(pullTarget(ray, [0, 0, 2], [0, 0, -1], 0), null);
  assert.equal(pullTarget({ ...ray, direction: [1, 0, 0] }, [0, 0, 0.2], [0, 0, -1], 0), null);
  assert.deepEqual([allowedDepth(1), allowedDepth(-1), allowedDepth(0.004)], [0.02, 0, 0.004]);
});

test("a value is the one of the device that was asked for", () => {
  const nodes = [
    { name: "/left/haptic_device: force", level: "ok", summary: "", values: { missed_deadlines: "3" } },
    { name: "/right/haptic_device: force", level: "ok", summary: "", values: { missed_deadlines: "5" } },
    { name: "/deformation: left", level: "ok", summary: "", values: { rate_hz: "999.5", step_p99_us: "-" } },
  ];
  const status = parse(JSON.stringify({ type: "status", nodes })) as Status;
  assert.deepEqual([valueFor(status, "left", "missed_deadlines"), valueFor(status, "right", "missed_deadlines")], [3, 5]);
  assert.equal(valueFor(status, "left", "rate_hz"), 999.5);
  assert.ok(Number.isNaN(valueFor(status, "left", "step_p99_us")) && Number.isNaN(valueFor(null, "", "rate_hz")));
});

test("a count becomes what it grows by in a second, and a restart is no negative rate", () => {
  const growth = new Growth();
  assert.deepEqual([0, 1, 2, 3].map((second) => growth.update(second, [5, 5, 9, 0][second])), [0, 0, 4, 0]);
  assert.equal(growth.update(4, NaN), 0);
});

test("a topic that nobody publishes is named", () => {
  assert.deepEqual(missingPublishers({ body_mesh: 1, contact_state: 2 }), []);
  assert.match(missingPublishers({ body_mesh: 1, contact_state: 0 })[0], /contact_state/);
});

test("text that is no message is none, whatever it is", () => {
  for (const text of ["", "{", "null", "[]", "7", '{"type":7}', '{"type":"what"}', '{"type":"hello"}', '{"type":"hello","protocol":2,"devices":[]}', '{"type":"chains","chains":[{"rod_length_m":null}]}', '{"type":"toString"}']) {
    assert.equal(parse(text), null, text);
  }
  const parameters = parse('{"type":"parameters","parameters":[{"name":"a","value":1},{"name":"b","value":{}},{"value":1},5]}');
  assert.deepEqual(parameters?.type === "parameters" && parameters.parameters.map((one) => one.name), ["a"]);
});
