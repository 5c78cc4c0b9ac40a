// What the page does when its node sends nonsense, changes the scene, hangs or dies. Against a stand-in: a real node must
// never do most of this.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep, launch, open, placeOnBody, read, until } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** A stand-in and a page that looks at it; both end with the test. */
async function visit(t, options) {
  const node = await new FakeNode(options).listen();
  const { page, errors, close } = await open(browser, { address: node.url });
  t.after(async () => {
    try {
      await close();
    } finally {
      await node.close();
    }
  });
  return { node, page, errors };
}

const counters = (page) => read(page, "counters");

test("garbage, cut, repeated and old frames are ignored and counted; the next good one counts", async (t) => {
  const { node, page } = await visit(t);
  const good = node.surface(10);
  node.send(good);
  await until(page, () => window.rhombus.moved.length > 0);
  const moved = (await read(page, "moved")).length;
  const unknown = new Uint8Array([9, 0, 0, 0, 1, 0, 0, 0]).buffer;
  const tooMany = node.surface(10).slice(0);
  new DataView(tooMany).setUint32(12, 0xffffffff, true);
  const noSuchVertex = node.surfaceOf([4_000_000_000], [0, 0, 0.01]);
  for (const buffer of [new ArrayBuffer(0), new ArrayBuffer(3), unknown, tooMany, good, node.surface(5).slice(0, 100), noSuchVertex]) node.send(buffer);
  node.say({ type: "what is this" });
  for (const socket of node.pages) socket.send("{");
  await until(page, () => window.rhombus.counters.garbage >= 7 && window.rhombus.counters.otherMesh >= 1);
  assert.deepEqual([(await counters(page)).outOfOrder, (await read(page, "moved")).length], [1, moved]);
  node.send(node.surfaceOf([0], [0, 0, -0.004]));
  await until(page, () => window.rhombus.moved.length === 1);
});

test("NaN is not drawn, and counted", async (t) => {
  const { node, page } = await visit(t);
  node.send(node.surfaceOf([0, 1, 2], [NaN, 0, 0, 0, 0, -0.001, 0, Infinity, 0]));
  node.send(node.state(3, { probe: [NaN, 0, 0] }));
  await until(page, () => window.rhombus.counters.notFinite >= 3);
  assert.deepEqual((await read(page, "moved")).map((one) => one.vertex), [1]);
});

test("what the node itself does not draw is counted on the page, too", async (t) => {
  const { node, page } = await visit(t);
  await page.locator("#counters", { hasText: /\b0 not drawn by the node/ }).waitFor({ state: "attached" });
  node.notDrawn = { not_drawable: 3, other_mesh: 1 };
  await page.locator("#counters", { hasText: /\b4 not drawn by the node/ }).waitFor({ state: "attached" });
});

test("the force of a device is what its motors apply; a command that they do not follow is said beside it", async (t) => {
  const { node, page } = await visit(t);
  await page.getByText("0.40", { exact: true }).first().waitFor();
  assert.equal(await page.locator(".device .note:visible").count(), 0);
  node.quiet();
  const timer = setInterval(() => node.send(node.state(0, { applied: 0 })), 50);
  t.after(() => clearInterval(timer));
  await page.getByText("motors 0.00 N, model 0.40 N: enabled").waitFor();
  const [number] = await page.locator(".device", { hasText: "Force" }).locator(".numbers div", { hasText: "Force" }).locator("dd").allTextContents();
  assert.equal(number, "0.00");
  await keep(page, "not-applied");
});

test("a scene that changes while the page is open: the new body is shown, updates of the old one are not", async (t) => {
  const { node, page } = await visit(t);
  const old = node.topologyVersion;
  node.topologyVersion = 2;
  node.setBody(800);
  node.send(node.mesh());
  await until(page, (vertices) => window.rhombus.mesh.vertices === vertices, node.xyz.length / 3);
  node.send(node.surfaceOf([1], [0, 0, 0.01], old));
  await until(page, () => window.rhombus.counters.otherMesh === 1);
  assert.equal((await read(page, "moved")).length, 0);
});

test("a body of 200 000 vertices is shown and moves", async (t) => {
  const { node, page } = await visit(t, { vertices: 200_000 });
  assert.ok((await read(page, "mesh")).vertices > 190_000);
  t.diagnostic(`first picture after ${(await read(page, "first_picture_ms")).toFixed(0)} ms`);
  node.send(node.surface(20));
  await until(page, () => window.rhombus.moved.length > 1000);
  await keep(page, "200k");
});

// How many a second is a benchmark's business (tests/benches/viewer_page.py): here, that none is lost between socket and picture.
for (const [vertices, rate] of [[3116, 60], [50_000, 40]]) {
  test(`${vertices} vertices: every update that is sent is received and applied`, async (t) => {
    const { node, page } = await visit(t, { vertices });
    node.play(rate);
    await page.waitForTimeout(1000);
    const sample = () => page.evaluate(() => ({ ...window.rhombus.counters, ms: performance.now() }));
    const before = await sample();
    await page.waitForTimeout(2500);
    const now = await sample();
    const perSecond = (key) => ((now[key] - before[key]) / (now.ms - before.ms)) * 1000;
    t.diagnostic(`received ${perSecond("received").toFixed(1)}/s, applied ${perSecond("applied").toFixed(1)}/s, pictures ${perSecond("pictures").toFixed(1)}/s, ${await read(page, "renderer")}`);
    assert.equal(now.applied, now.received);
    assert.ok(now.received > before.received);
    assert.equal(now.garbage + now.outOfOrder, 0);
  });
}

test("a publisher of which the node says that it is gone is said, and so is its return", async (t) => {
  const { node, page } = await visit(t);
  node.publishers = { ...node.publishers, contact_state: 0 };
  node.say(node.status());
  await page.getByText(/Nothing comes on contact_state/).waitFor();
  await keep(page, "publisher-gone");
  node.publishers = { ...node.publishers, contact_state: 1 };
  node.say(node.status());
  await page.getByText(/Nothing comes on contact_state/).waitFor({ state: "detached" });
});

test("a device of which nothing comes is said, and so is its return", async (t) => {
  const { node, page } = await visit(t);
  node.device = { alive: false };
  await page.getByText(/Nothing comes from haptic_device/).waitFor();
  node.device = {};
  await page.getByText(/Nothing comes from haptic_device/).waitFor({ state: "detached" });
});

test("a cursor that the device does not reach is said where the hand is shown", async (t) => {
  const { node, page } = await visit(t);
  node.device = { pointer: true, out_of_reach: true };
  node.say(node.status());
  await until(page, () => window.rhombus.pointer.device !== null);
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.getByText("out of the device's reach").waitFor();
  await keep(page, "out-of-reach");
  node.device = { pointer: true };
  await page.getByText("pressing", { exact: true }).waitFor();
  await page.mouse.up();
});

test("a cursor that rests over the body gives the device back, one that moves or presses keeps it", async (t) => {
  const { node, page } = await visit(t);
  node.device = { pointer: true };
  node.say(node.status());
  await until(page, () => window.rhombus.pointer.device !== null);
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.waitForTimeout(5500);
  assert.equal((await read(page, "pointer")).hold, "ours", "it presses");
  await page.mouse.up();
  for (let i = 0; i < 6; i += 1) {
    await page.mouse.move(x + (i % 2), y);
    await page.waitForTimeout(1000);
  }
  assert.equal((await read(page, "pointer")).hold, "ours", "it moves");
  await page.waitForTimeout(5500);
  assert.deepEqual([(await read(page, "pointer")).hold, node.released], ["free", 1]);
});

test("a page that was refused the device may ask again when the other one has let go, and says so", async (t) => {
  const { node, page } = await visit(t);
  [node.grants, node.device] = [false, { pointer: true, held: true }];
  node.say(node.status());
  await until(page, () => window.rhombus.pointer.device !== null);
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.up();
  await page.getByText("another page moves it").waitFor();
  await page.waitForTimeout(1000);
  assert.equal((await read(page, "pointer")).hold, "refused");
  node.device = { pointer: true, held: false };
  await page.getByText("drag on the body to press").waitFor();
  assert.equal((await read(page, "pointer")).hold, "free");
});

test("a node that hangs is said to be silent within about a second, and nothing old looks like new", async (t) => {
  const { node, page } = await visit(t);
  await page.getByText("1000", { exact: true }).first().waitFor();
  node.quiet();
  await until(page, () => window.rhombus.connection.phase === "silent");
  assert.equal(await page.locator(".numbers dd").first().textContent(), "–");
});

test("a node that dies and comes back at the same port: the page says so and reconnects by itself", async (t) => {
  const node = await new FakeNode().listen();
  const { page, errors } = await open(browser, { address: node.url });
  await node.close();
  let again = null;
  t.after(async () => {
    await page.context().close();
    await again?.close();
  });
  await until(page, () => ["waiting", "connecting"].includes(window.rhombus.connection.phase));
  assert.match(await page.locator("#connection").textContent(), /lost/);
  await keep(page, "lost");
  again = await new FakeNode({ vertices: 1000 }).listen(node.port);
  await until(page, () => window.rhombus.connection.phase === "connected");
  await until(page, (vertices) => window.rhombus.mesh.vertices === vertices, again.xyz.length / 3);
  assert.equal((await read(page, "connection")).reconnects, 1);
  assert.match(await page.locator("#connection").textContent(), /Connected/);
  // A browser itself writes refused connections to the console; the page adds nothing.
  assert.deepEqual(errors.filter((text) => !/ERR_CONNECTION_REFUSED|WebSocket connection/.test(text)), []);
});
