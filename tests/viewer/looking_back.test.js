// The last minute: what is kept of it, looking back at it, and what must not happen meanwhile. Against a stand-in, whose
// times and frames are known.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { keep, launch, open, placeOnBody, read, until } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** A small picture and few updates: what is drawn without a graphics card takes the time that the page needs for this. */
const SIZE = { width: 900, height: 500 };
const RATE_HZ = 12;

/** A stand-in and a page that looks at it; both end with the test. */
async function visit(t, options) {
  const node = await new FakeNode({ vertices: 800, ...options }).listen();
  const { page } = await open(browser, { address: node.url, ...SIZE });
  t.after(async () => {
    await page.context().close();
    await node.close();
  });
  return { node, page };
}

/** Sets the slider at once: a page that draws all the time lets a real cursor wait. */
const lookBack = async (page, agoS) => {
  await page.evaluate((ago) => {
    const slider = document.querySelector("#timeline input");
    slider.step = "any";
    slider.value = String(-ago);
    slider.dispatchEvent(new Event("input"));
  }, agoS);
  assert.ok(Math.abs((await read(page, "lookingBackS")) - agoS) < 1e-6);
};
const goLive = (page) => page.evaluate(() => document.querySelector(".live").click());

/** Columns of the plotted window by name; null where a field is empty. */
async function table(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.evaluate(() => document.getElementById("csv").click())]);
  const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\n").map((line) => line.split(","));
  return Object.fromEntries(head.map((name, i) => [name, lines.map((line) => (line[i] === "" ? null : Number(line[i])))]));
}

const steps = (values) => values.slice(1).map((value, i) => value - values[i]);

test("recording goes on while somebody looks back: no hole in the plots, in the CSV, or in what can be looked at", async (t) => {
  const { node, page } = await visit(t);
  // States of surfaces only, none in between.
  node.quiet();
  node.play(RATE_HZ);
  await page.waitForTimeout(1500);
  await lookBack(page, 1);
  const [held, moved, before] = [await table(page), await read(page, "moved"), (await read(page, "counters")).states];
  await page.waitForTimeout(2500);
  assert.deepEqual(await table(page), held, "what is looked at stays");
  assert.deepEqual(await read(page, "moved"), moved);
  await goLive(page);
  await page.waitForTimeout(400);
  const states = (await read(page, "counters")).states - before;
  await lookBack(page, 1);
  const { time_s: times, seconds_before_end: ago, depth_mm: depths } = await table(page);
  const rows = times.flatMap((time, row) => (time > held.time_s.at(-1) ? [row] : []));
  assert.ok(rows.length >= states - 2, `${rows.length} rows of ${states} states that came`);
  const seen = new Set();
  for (const row of rows.filter((_, i) => i % Math.ceil(rows.length / 8) === 0)) {
    await lookBack(page, Math.max(ago[row], 0.1));
    seen.add(Math.max(...(await read(page, "moved")).map(({ displacement }) => Math.abs(displacement[2]))));
  }
  assert.ok(new Set(rows.map((row) => depths[row])).size > 4, "the depths of that time are there");
  assert.ok(seen.size > 2, `${[...seen]}: the surfaces of that time are there`);
});

test("no line is drawn over silence", async (t) => {
  const { node, page } = await visit(t);
  await page.waitForTimeout(600);
  node.quiet();
  await page.waitForTimeout(1500);
  node.play(RATE_HZ);
  await page.waitForTimeout(600);
  const { seconds_before_end: ago, depth_mm: depths } = await table(page);
  const longest = steps(ago).indexOf(Math.min(...steps(ago)));
  assert.ok(depths[longest] === null || depths[longest + 1] === null, "a row without numbers stands in the silence");
});

test("the axis is the server's time, however late a state arrives", async (t) => {
  const { node, page } = await visit(t);
  node.quiet();
  const begunS = Date.now() / 1000;
  for (let burst = 0; burst < 10; burst += 1) {
    await page.waitForTimeout(150 + 80 * (burst % 3));
    for (let i = 0; i < 8; i += 1) node.send(node.state(i, { serverTimeS: begunS + 0.025 * (8 * burst + i) }));
  }
  await until(page, () => window.rhombus.counters.states >= 80);
  const { time_s: times, seconds_before_end: ago } = await table(page);
  const first = times.findIndex((time) => time >= begunS - 1e-6);
  assert.equal(times.length - first, 80);
  steps(times.slice(first)).forEach((step) => assert.ok(Math.abs(step - 0.025) < 1e-4));
  steps(ago.slice(first)).forEach((step) => assert.ok(Math.abs(step + 0.025) < 1e-3, `${-step} s on the axis, 0.025 s by the server`));
});

test("a press while looking back goes to live first, and says so", async (t) => {
  const { node, page } = await visit(t, { pointer: true });
  await page.locator("#hand").waitFor();
  await page.waitForTimeout(1500);
  await lookBack(page, 1);
  assert.match(await page.locator(".hold").textContent(), /looking back/);
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  const told = until(page, () => window.rhombus.notices.some((text) => /Back to live/.test(text)));
  await page.mouse.down();
  await told;
  await until(page, () => window.rhombus.pointer.target !== null);
  assert.equal(await read(page, "lookingBackS"), 0);
  assert.equal(await page.locator(".live").getAttribute("aria-pressed"), "true");
  await page.mouse.up();
  assert.ok(node.pointed.some((message) => message.type === "pointer_take"));
});

test("nothing moves the device while somebody looks back", async (t) => {
  const { node, page } = await visit(t, { pointer: true });
  await page.locator("#hand").waitFor();
  await page.waitForTimeout(1500);
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(page, () => window.rhombus.pointer.hold === "ours");
  await page.keyboard.press(",");
  await until(page, () => window.rhombus.lookingBackS > 0);
  await page.waitForTimeout(100);
  const said = () => node.pointed.filter((message) => message.type === "pointer_target").length;
  const before = said();
  await page.mouse.move(x + 10, y, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(x - 10, y, { steps: 4 });
  await page.waitForTimeout(300);
  assert.equal(said(), before);
});

test("a node that comes back with the same body leaves the last minute and the past picture alone", async (t) => {
  const first = await new FakeNode({ vertices: 800 }).listen();
  const { page } = await open(browser, { address: first.url, ...SIZE });
  let node = first;
  t.after(async () => {
    await page.context().close();
    await node.close();
  });
  first.play(RATE_HZ);
  await page.waitForTimeout(2000);
  await lookBack(page, 1);
  const moved = await read(page, "moved");
  assert.ok(moved.length > 0);
  const shown = await page.locator(".numbers dd").first().textContent();
  await first.close();
  await until(page, () => window.rhombus.connection.phase === "waiting");
  assert.equal(await page.locator(".numbers dd").first().textContent(), shown, "the numbers of the past stay");
  await keep(page, "looking-back-lost");
  // Longer than what counts as silence, however quick the page is to come back.
  await page.waitForTimeout(1000);
  node = await new FakeNode({ vertices: 800 }).listen(first.port);
  await until(page, () => window.rhombus.connection.phase === "connected");
  await page.waitForTimeout(500);
  assert.deepEqual([await read(page, "lookingBackS"), await read(page, "moved")], [1, moved]);
  await goLive(page);
  await until(page, () => window.rhombus.moved.length === 0);
  const { seconds_before_end: ago, depth_mm: depths } = await table(page);
  const times = ago.map((value) => -value);
  const lost = steps(times).indexOf(Math.max(...steps(times)));
  assert.ok(lost > 4 && times.length > lost + 2, "rows from before and after");
  assert.ok(depths.includes(null));
  await lookBack(page, Math.round((times.at(-1) - times[Math.max(lost - 3, 0)]) * 10) / 10);
  assert.ok((await read(page, "moved")).length > 0, "the surface of before the restart is still there");
});

test("another body ends looking back: there is nothing of it to look at", async (t) => {
  const { node, page } = await visit(t);
  await page.waitForTimeout(1500);
  await lookBack(page, 1);
  node.topologyVersion = 2;
  node.setBody(500);
  node.send(node.mesh());
  await until(page, (vertices) => window.rhombus.mesh.vertices === vertices, node.xyz.length / 3);
  await until(page, () => window.rhombus.lookingBackS === 0);
});
