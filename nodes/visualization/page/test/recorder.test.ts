import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, type StateFrame, type SurfaceFrame } from "../src/frames.ts";
import type { Status } from "../src/messages.ts";
import { parse } from "../src/messages.ts";
import { column } from "../src/plots.ts";
import { Recorder } from "../src/recorder.ts";
import { stateFrame, surfaceFrame } from "./bytes.ts";

const MISSED = 4;

const state = (sequence: number, serverTimeS: number): StateFrame => ({
  ...(decode(stateFrame(sequence, [{ flags: 7, depth: 0.002, mode: 1 }])) as StateFrame),
  serverTimeS,
});
const surface = (sequence: number, stampS: number): SurfaceFrame => ({
  ...(decode(surfaceFrame(sequence, 1, [0], [0, 0, 0])) as SurfaceFrame),
  stampS,
});
const driver = (stampS: number, missed: number, level = "ok"): Status =>
  parse(JSON.stringify({ type: "status", nodes: [{ name: "/haptic_device: force", level, stamp_s: stampS, values: { missed_deadlines: String(missed) } }] })) as Status;

function recorder(): Recorder {
  const made = new Recorder();
  made.setDevices([""]);
  return made;
}

/** Missed deadlines a second at each row. */
const missedOf = ({ minute: { series } }: Recorder): number[] =>
  Array.from({ length: series.length }, (_, i) => series.value(i, column(0, MISSED)));

test("a steady 100 missed deadlines a second is 100, whenever the page hears of them", () => {
  const made = recorder();
  for (let i = 0; i < 60 * 20; i += 1) {
    const timeS = i / 60;
    // Diagnostics once a second and a bit, which the page hears of up to a quarter of a second later.
    const stampS = Math.floor((timeS - 0.13) / 1.003) * 1.003;
    made.addState(timeS, state(i, 1000 + timeS), driver(stampS, Math.round(100 * (stampS + 2))));
  }
  const rates = missedOf(made).slice(180);
  assert.ok(Math.max(...rates) < 101 && Math.min(...rates) > 99, `${Math.min(...rates)} to ${Math.max(...rates)}`);
});

test("a driver that has gone silent misses an unknown number of deadlines", () => {
  const made = recorder();
  [0, 1, 2].forEach((timeS) => made.addState(timeS, state(timeS, timeS), driver(timeS, 10 * timeS)));
  made.addState(2.3, state(3, 2.3), driver(2, 20, "stale"));
  assert.ok(Number.isNaN(missedOf(made).at(-1)));
  made.addState(2.4, state(4, 2.4), driver(9, 900));
  assert.equal(missedOf(made).at(-1), 0, "what happened meanwhile is not of the last second");
});

test("rows lie as far apart as the server's times, and a step of its clock does not turn the axis round", () => {
  const made = recorder();
  // Times on the page jitter by a fifth of a second.
  for (let i = 0; i < 100; i += 1) made.addState(5 + 0.02 * i + 0.2 * (i % 3 === 0 ? 1 : 0), state(i, 1e9 + 0.02 * i), null);
  const times = made.minute.series.times(0, 100);
  times.slice(1).forEach((time, i) => assert.ok(Math.abs(time - times[i] - 0.02) < 1e-6));
  made.addState(7.2, state(100, 3), null);
  made.addState(7.3, state(101, 3.1), null);
  const after = made.minute.series.times(100, made.minute.series.length);
  assert.ok([times[99], ...after].every((time, i, all) => i === 0 || time > all[i - 1]), `${after}`);
  assert.ok(Math.abs(after[after.length - 1] - after[after.length - 2] - 0.1) < 1e-6);
});

test("a surface is kept at its stamp, or, when that is of another clock, when it came", () => {
  const made = recorder();
  made.addState(10, state(0, 1000), null);
  made.addSurface(10.3, surface(1, 1000.1));
  made.addSurface(10.6, surface(2, 5));
  // The page was held up: the surface is older than its arrival says.
  made.addState(11, state(1, 1001), null);
  made.addSurface(15, surface(3, 1001.2));
  const { history } = made.minute;
  assert.equal(history.surfaceAt(11.3)?.sequence, 3);
  assert.deepEqual([10.05, 10.2, 10.5, 10.7].map((timeS) => history.surfaceAt(timeS)?.sequence ?? null), [null, 1, 1, 2]);
});

test("silence is a row without numbers; what is held stays while recording goes on", () => {
  const made = recorder();
  for (let i = 0; i < 10; i += 1) made.addState(0.1 * i, state(i, 50 + 0.1 * i), null);
  made.hold();
  made.addState(3, state(10, 53), null);
  made.addSurface(3, surface(11, 53));
  const held = made.minute;
  assert.deepEqual([held.series.length, held.history.stateAt(4)?.sequence, held.history.surfaceAt(4)], [10, 9, null]);
  made.letGo();
  const { series, history } = made.minute;
  const depths = series.column(column(0, 0), 0, series.length);
  assert.deepEqual([depths.length, depths[10], depths[11]], [12, null, depths[0]]);
  assert.deepEqual([history.stateAt(4)?.sequence, history.surfaceAt(4)?.sequence], [10, 11]);
});
