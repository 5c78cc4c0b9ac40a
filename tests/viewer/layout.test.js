// What lies over the picture: nothing over something else, little over the body, and nothing that says nothing.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep, launch, open, read, until } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

async function visit(t, node, options) {
  const { page, close } = await open(browser, { address: node.url, ...options });
  t.after(async () => {
    try {
      await close();
    } finally {
      await node.close();
    }
  });
  return page;
}

/** In the page: pairs of things over the picture that overlap. */
function overlaps() {
  const boxes = [...document.querySelectorAll(".legend, .view-buttons, #hand, .timeline, .axes-block, .scale-bar, .bar, .notice")]
    .map((element) => ({ name: element.id || element.className, ...element.getBoundingClientRect().toJSON() }))
    .filter(({ width, height }) => width > 0 && height > 0);
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  return boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => meet(a, b)).map((b) => `${a.name} and ${b.name}`));
}

/** In the page: notices whose button is covered or cut off. */
function unreachable() {
  const notices = [...document.querySelectorAll(".notice")].filter((notice) => {
    const button = notice.querySelector("button");
    const { left, top, width, height } = button.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2) !== button;
  });
  return notices.map((notice) => notice.textContent);
}

/** In the page: the share of the body, as it is seen, that something covers. */
function covered() {
  const { left, top, width, height } = document.getElementById("picture").getBoundingClientRect();
  let [seen, hidden] = [0, 0];
  for (let x = 4; x < width; x += 8) {
    for (let y = 4; y < height; y += 8) {
      if (!window.rhombus.pick(x, y)) continue;
      seen += 1;
      if (document.elementFromPoint(left + x, top + y)?.id !== "picture") hidden += 1;
    }
  }
  return hidden / seen;
}

// Places do not depend on colours; pages of both themes at these sizes are looked at in page.test.js.
const SIZES = [["phone", 400, 800, "light"], ["landscape", 850, 390, "dark"], ["wide", 1280, 720, "light"], ["uhd", 3840, 2160, "dark"]];
for (const [name, width, height, theme] of SIZES) {
  test(`${name}, ${theme}: notices lie over nothing, and can be closed; the body is seen`, async (t) => {
    const node = await new FakeNode({ vertices: 800, pointer: true }).listen();
    const page = await visit(t, node, { width, height, theme });
    await page.locator("#hand").waitFor();
    await page.waitForTimeout(300);
    const share = await page.evaluate(covered);
    node.publishers = { body_mesh: 1, surface_displacement: 0, contact_state: 0 };
    node.operatingState = "FAULT";
    node.say(node.status());
    await until(page, () => document.querySelectorAll(".notice").length === 2);
    await keep(page, `notices-${name}-${theme}`);
    const withNotices = await page.evaluate(covered);
    t.diagnostic(`covered: ${(100 * share).toFixed(0)} % of the body, with notices ${(100 * withNotices).toFixed(0)} %`);
    assert.deepEqual(await page.evaluate(overlaps), []);
    assert.deepEqual(await page.evaluate(unreachable), [], "notices whose button cannot be clicked");
    assert.ok(share < 0.2 && withNotices < 0.3, `${share} and ${withNotices} of the body are covered`);
    await page.evaluate(() => document.querySelector(".notice button").click());
    await until(page, () => document.querySelectorAll(".notice").length <= 1);
    const closed = (await read(page, "notices")).length;
    node.say(node.status());
    await page.waitForTimeout(600);
    assert.ok((await read(page, "notices")).length <= closed, "what was closed stays closed while it is still so");
  });
}

test("before there is a body nothing speaks of it: no scale, no axes, no colours", async (t) => {
  const node = await new FakeNode({ vertices: 800, bodiless: true }).listen();
  const page = await visit(t, node, { drawn: false });
  await until(page, () => window.rhombus.connection.phase === "connected");
  for (const thing of [".legend", ".axes", ".scale-bar"]) assert.equal(await page.locator(thing).isVisible(), false, thing);
  assert.equal(await page.locator("#waiting").isVisible(), true);
  await keep(page, "no-body");
  node.send(node.mesh());
  await until(page, () => window.rhombus.first_picture_ms !== null);
  for (const thing of [".legend", ".axes", ".scale-bar"]) assert.equal(await page.locator(thing).isVisible(), true, thing);
});
