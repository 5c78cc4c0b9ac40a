import assert from "node:assert/strict";
import { test } from "node:test";
import { decode } from "../src/frames.ts";
import { Inbox } from "../src/inbox.ts";
import { meshFrame, stateFrame, surfaceFrame } from "./bytes.ts";

test("a mesh frame has its vertices, triangles and factors", () => {
  const frame = decode(meshFrame(7, [0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2], [1, 2, 0.5]));
  assert.equal(frame.kind, "mesh");
  if (frame.kind !== "mesh") return;
  assert.deepEqual([frame.topologyVersion, frame.positions.length, [...frame.corners]], [7, 9, [0, 1, 2]]);
  assert.deepEqual([...(frame.stiffness ?? [])], [1, 2, 0.5]);
});

test("a mesh that cannot be drawn is refused and says why", () => {
  const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0];
  const reasons = [
    meshFrame(1, [NaN, ...corners.slice(1)], [0, 1, 2]),
    meshFrame(1, corners, [0, 1, 3]),
    meshFrame(1, corners, [0, 1, 2], [1, -1, 1]),
    meshFrame(1, corners, []),
  ].map((buffer) => decode(buffer));
  assert.deepEqual(
    reasons.map((frame) => frame.kind === "garbage" && frame.reason),
    [
      "a mesh with a position that is not finite",
      "a triangle with a vertex that does not exist",
      "a stiffness factor that is not above 0 and finite",
      "a mesh without a triangle",
    ],
  );
});

test("no cut of a frame, and no random bytes, are taken for a frame or throw", () => {
  for (const whole of [surfaceFrame(1, 1, [3], [0, 0, 1]), stateFrame(1, [{}]), meshFrame(1, [0, 0, 0], [0, 0, 0])]) {
    for (let bytes = 0; bytes < whole.byteLength; bytes += 1) {
      assert.equal(decode(whole.slice(0, bytes)).kind, "garbage", `${bytes} bytes`);
    }
    assert.notEqual(decode(whole).kind, "garbage");
  }
  let seed = 1;
  for (let round = 0; round < 2000; round += 1) {
    const bytes = new Uint8Array(round % 300).map(() => (seed = (seed * 16807) % 2147483647) & 255);
    if (bytes.length > 0) bytes[0] = round % 5;
    decode(bytes.buffer);
  }
});

test("a count that would need more memory than there is, is refused by the frame's length", () => {
  const buffer = surfaceFrame(1, 1, [3], [0, 0, 1]);
  new DataView(buffer).setUint32(12, 0xffffffff, true);
  assert.equal(decode(buffer).kind, "garbage");
});

test("a state frame has every field where the protocol puts it", () => {
  const frame = decode(
    stateFrame(5, [
      {
        mode: 2, flags: 0b1111111, stamp: 12.5, probe: [1, 2, 3], quaternion: [0, 0, 0, 1], proxy: [4, 5, 6],
        normal: [0, 0, 1], force: [7, 8, 9], depth: 0.25, normalForce: 2, stiffness: 200, latency: 0.5, rate: 1000,
        handle: [10, 11, 12], command: [13, 14, 15],
      },
    ]),
  );
  assert.equal(frame.kind, "state");
  if (frame.kind !== "state") return;
  assert.deepEqual(frame.devices[0], {
    mode: "grasp", contactHeard: true, forceHeard: true, forceApplied: true, commandHeard: true, poseHeard: true, saturated: true, clutched: true,
    stampS: 12.5, probe: [1, 2, 3], probeQuaternion: [0, 0, 0, 1], proxy: [4, 5, 6], normal: [0, 0, 1],
    force: [7, 8, 9], command: [13, 14, 15], depthM: 0.25, normalForceN: 2, stiffnessNPerM: 200, latencyS: 0.5, poseRateHz: 1000,
    handle: [10, 11, 12],
  });
});

test("what is not finite in a state is not shown, and counted", () => {
  const frame = decode(stateFrame(1, [{ mode: 1, flags: 7, proxy: [NaN, 0, 0] }, { flags: 7, force: [0, Infinity, 0] }]));
  assert.equal(frame.kind, "state");
  if (frame.kind !== "state") return;
  assert.equal(frame.notFinite, 2);
  assert.deepEqual(
    frame.devices.map((one) => [one.mode, one.contactHeard, one.forceHeard]),
    [["none", false, true], ["none", true, false]],
  );
});

test("old, repeated and garbage frames are ignored and counted; a gap counts as dropped", () => {
  const inbox = new Inbox();
  const taken = [3, 4, 4, 2, 8].map((sequence) => inbox.receive(surfaceFrame(sequence, 1, [], [])) !== null);
  assert.deepEqual(taken, [true, true, false, false, true]);
  assert.equal(inbox.receive(new ArrayBuffer(5)), null);
  assert.deepEqual([inbox.counts.surfaces, inbox.counts.outOfOrder, inbox.counts.missing, inbox.counts.garbage], [3, 2, 3, 1]);
  // Each kind has its own order; numbers wrap.
  assert.ok(inbox.receive(stateFrame(0xffffffff, [])) && inbox.receive(stateFrame(0, [])));
  inbox.reset();
  assert.ok(inbox.receive(surfaceFrame(1, 1, [], [])));
});
