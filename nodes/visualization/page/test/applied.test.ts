import assert from "node:assert/strict";
import { test } from "node:test";
import { ForceDifference } from "../src/applied.ts";
import { decode, type DeviceState } from "../src/frames.ts";
import { Recorder } from "../src/recorder.ts";
import { csv } from "../src/table.ts";
import { stateFrame } from "./bytes.ts";

const APPLIED = 2 | 32 | 64;
const COMMANDED = 2 | 64;

function frame(flags: number, force: number, command: number) {
  const decoded = decode(stateFrame(1, [{ flags, force: [0, 0, force], command: [0, 0, command] }]));
  assert.equal(decoded.kind, "state");
  if (decoded.kind !== "state") throw new Error("no state");
  return decoded;
}

const device = (flags: number, force: number, command: number): DeviceState => frame(flags, force, command).devices[0];

test("motors that do not give what the model commands are said on the card, with the device's state, when it lasts", () => {
  const difference = new ForceDifference();
  const disabled = device(APPLIED, 0, 1.19);
  assert.equal(difference.update(0, disabled, "disabled"), "");
  assert.equal(difference.update(300, disabled, "disabled"), "motors 0.00 N, model 1.19 N: disabled");
  assert.equal(difference.update(400, device(APPLIED, 1.15, 1.19), "enabled"), "");
  assert.equal(difference.update(500, disabled, "disabled"), "", "anew");
  assert.equal(difference.update(900, undefined, ""), "");
});

test("a command in place of a force that nobody measures is said to be one", () => {
  assert.match(new ForceDifference().update(0, device(COMMANDED, 1.19, 1.19), ""), /^the model's command/);
});

test("the CSV has what is applied and what is commanded under names of their own", () => {
  const recorder = new Recorder();
  recorder.setDevices(["left"]);
  recorder.addState(1, frame(APPLIED, 0, 1.25), null);
  recorder.addState(2, frame(COMMANDED, 1.5, 1.5), null);
  const [header, ...rows] = csv(recorder.minute.series, recorder.devices, 0, 3, recorder.serverColumn).trim().split("\n").map((line) => line.split(","));
  const [applied, commanded] = ["left_applied_force_n", "left_commanded_force_n"].map((name) => header.indexOf(name));
  assert.deepEqual(rows.map((row) => [row[applied], row[commanded]]), [["0", "1.25"], ["", "1.5"]]);
});
