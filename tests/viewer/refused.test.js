// A page for which the node has no room (viewer.max_pages). Against a stand-in: a real node would need as many pages.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep, launch, open, read, until } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

test("a page that is not let in says why, asks rarely, and comes in when there is room", async (t) => {
  const node = await new FakeNode({ vertices: 800, full: true }).listen();
  const { page } = await open(browser, { address: node.url, drawn: false });
  t.after(async () => {
    await page.context().close();
    await node.close();
  });
  await until(page, () => window.rhombus.connection.phase === "waiting");
  for (const place of ["#connection", "#waiting"]) assert.match(await page.locator(place).textContent(), /1 pages are open.*viewer\.max_pages/);
  await keep(page, "no-room");
  await page.waitForTimeout(4000);
  assert.ok(node.connections <= 2, `${node.connections} connections in about five seconds`);
  assert.equal((await read(page, "connection")).reconnects, 0, "it was never connected");
  assert.match(await page.locator("#connection").textContent(), /max_pages/);
  node.full = false;
  await until(page, () => window.rhombus.connection.phase === "connected" && window.rhombus.mesh !== null);
  assert.equal(await page.locator("#waiting").isVisible(), false);
});
