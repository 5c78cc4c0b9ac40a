// Fingers and keys as a hand, against a stand-in that notes what it is asked for.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, placeOnBody, read, until } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

async function visit(t, options) {
  const node = await new FakeNode({ pointer: true, vertices: 800 }).listen();
  const { page, close } = await open(browser, { address: node.url, width: 900, height: 500, ...options });
  t.after(async () => {
    try {
      await close();
    } finally {
      await node.close();
    }
  });
  await page.locator("#hand").waitFor();
  const targets = () => node.pointed.filter((message) => message.type === "pointer_target");
  const holds = async () => {
    for (const endMs = Date.now() + 5000; Date.now() < endMs; await page.waitForTimeout(50)) if (targets().some(({ grasp }) => grasp)) return true;
    return false;
  };
  return { node, page, targets, holds };
}

test("Space with the tool Pull grasps", async (t) => {
  const { page, holds, targets } = await visit(t);
  await page.getByRole("radio", { name: "Pull" }).check({ force: true });
  await page.focus("#picture");
  await page.keyboard.down(" ");
  assert.ok(await holds());
  await page.keyboard.press("]");
  await page.keyboard.up(" ");
  await page.waitForTimeout(200);
  assert.equal(targets().at(-1).grasp, false);
});

test("Shift and Space grasps, Space alone presses", async (t) => {
  const { page, holds, targets } = await visit(t);
  await page.focus("#picture");
  await page.keyboard.down(" ");
  await until(page, () => window.rhombus.pointer.target !== null);
  await page.waitForTimeout(800);
  await page.keyboard.up(" ");
  assert.ok(targets().length > 0 && targets().every(({ grasp }) => !grasp));
  await page.keyboard.down("Shift");
  await page.keyboard.down(" ");
  assert.ok(await holds());
  await page.keyboard.up(" ");
  await page.keyboard.up("Shift");
});

test("a press with Space ends when the window loses the keyboard", async (t) => {
  const { page, targets } = await visit(t);
  assert.equal(await page.evaluate(() => document.activeElement === document.body), true);
  await page.keyboard.down(" ");
  await until(page, () => window.rhombus.pointer.hold === "ours");
  await page.evaluate(() => window.dispatchEvent(new Event("blur")));
  await page.waitForTimeout(200);
  const before = targets().length;
  await page.waitForTimeout(300);
  assert.equal(targets().length, before, "targets stop");
});

test("a pinch whose fingers come one after the other presses nothing; a finger that stays does", async (t) => {
  const { node, page } = await visit(t, { width: 400, height: 800, touch: true });
  const { x, y } = await placeOnBody(page);
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  // Slow machines deliver late: the pause is in the page.
  const pair = (gap) => [{ x, y, id: 1 }, { x: x + 30 + gap, y: y + 10, id: 2 }];
  const before = await read(page, "view");
  await touch("touchStart", pair(0).slice(0, 1));
  await page.waitForTimeout(60);
  await touch("touchStart", pair(0));
  for (let gap = 5; gap <= 60; gap += 5) await touch("touchMove", pair(gap));
  await touch("touchEnd", []);
  await until(page, (distance) => window.rhombus.view.distanceM < 0.9 * distance, before.distanceM);
  assert.deepEqual(node.pointed, []);
  await page.evaluate((view) => window.rhombus.setView(view), before);
  await touch("touchStart", [{ x, y, id: 3 }]);
  await until(page, () => window.rhombus.pointer.hold === "ours");
  await touch("touchEnd", []);
  await page.waitForTimeout(100);
  const takes = () => node.pointed.filter(({ type }) => type === "pointer_take").length;
  assert.equal(takes(), 1);
});

test("a finger that moves at once presses at once", async (t) => {
  const { page } = await visit(t, { width: 400, height: 800, touch: true });
  const { x, y } = await placeOnBody(page);
  const session = await page.context().newCDPSession(page);
  const view = await read(page, "view");
  await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y, id: 1 }] });
  for (let i = 1; i < 5; i += 1) await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [{ x: x + 5 * i, y, id: 1 }] });
  await until(page, () => window.rhombus.pointer.hold === "ours");
  assert.deepEqual(await read(page, "view"), view, "the view does not turn");
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
});
