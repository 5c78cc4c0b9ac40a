// What the page does together with the node: parameters, and the mouse as a hand where a device follows it.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep, launch, note, open, placeOnBody, read, until } from "./browser.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const subtract = (a, b) => a.map((part, i) => part - b[i]);
const norm = (a) => Math.hypot(...a);

/** The device that the mouse moves, or null. */
async function pointerDevice(page) {
  await until(page, () => window.rhombus.status !== null);
  return page.evaluate(() => window.rhombus.status.devices.find((device) => device.pointer)?.name ?? null);
}

/** In the page: whether the probe has been at the same depth for half a second. */
function restsAt(name) {
  const { depthM } = window.rhombus.devices[name];
  const { depthM: before, sinceMs } = (window.rest ??= { depthM, sinceMs: performance.now() });
  if (depthM > 0.001 && Math.abs(depthM - before) < 5e-5) return performance.now() - sinceMs > 500;
  window.rest = { depthM, sinceMs: performance.now() };
  return false;
}

test("a parameter is changed live, the picture follows, and what is not accepted is refused with a reason", async (t) => {
  const { page, close } = await open(browser);
  await until(page, () => window.rhombus.parameters.length > 0);
  const parameters = await read(page, "parameters");
  assert.ok(parameters.every((one) => !/^(safety|device|unsafe)\./.test(one.name)), "only what is safe to change is offered");
  const scale = parameters.find((one) => one.name === "visualization.full_scale");
  if (!scale) return t.skip("this node offers no visualization.full_scale");
  const field = page.getByLabel("visualization.full_scale", { exact: true });
  const set = async (value) => {
    await field.fill(String(value));
    await field.press("Enter");
  };
  await set(0.008);
  await until(page, () => window.rhombus.parameters.find((one) => one.name === "visualization.full_scale").value === 0.008);
  await until(page, () => document.querySelector("canvas.scale").getAttribute("aria-label").includes("8 mm"));
  await set(-1);
  const row = page.locator(".parameter", { has: field });
  await row.getByText(/^refused: ./).waitFor();
  assert.equal((await read(page, "parameters")).find((one) => one.name === scale.name).value, 0.008);
  await keep(page, "parameters");
  await set(scale.value);
  await row.getByText(/^set$/).waitFor();
  await close();
});

test("a press moves vertices near the cursor by what the model says, and shows its force", async (t) => {
  const { page, close } = await open(browser);
  const device = await pointerDevice(page);
  if (device === null) {
    await close();
    return t.skip("no device follows the mouse in this scene");
  }
  const { x, y, hit } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(page, (name) => {
    const state = window.rhombus.devices[name];
    return state?.mode === "contact" && state.depthM > 0.001 && window.rhombus.moved.length > 0;
  }, device);
  await until(page, restsAt, device);
  const { state, moved } = await page.evaluate((name) => {
    const { devices, moved } = window.rhombus;
    return { state: devices[name], moved };
  }, device);
  await keep(page, "pressed");
  note("pressed", { moved, state });
  // The vertex that moved most is at the contact, and moved by at most the depth.
  const largest = moved.reduce((most, one) => (norm(one.displacement) > norm(most.displacement) ? one : most));
  assert.ok(norm(subtract(largest.rest, hit.point)) < 0.015, "the dent is under the cursor");
  assert.ok(norm(largest.displacement) <= 1.05 * state.depthM, `${norm(largest.displacement)} of ${state.depthM}`);
  assert.ok(norm(largest.displacement) > 0.2 * state.depthM);
  assert.ok(norm(state.force) > 0.05, "a press has a force");
  const outward = state.force.reduce((sum, part, i) => sum + part * state.normal[i], 0) / norm(state.force);
  assert.ok(outward > 0.9, "the force pushes the probe out");
  const chains = await read(page, "chains");
  if (chains?.chains.length > 0) assert.ok((await read(page, "units")) > 0, "the chains are drawn");
  assert.equal((await read(page, "pointer")).hold, "ours");
  await page.mouse.up();
  await until(page, (name) => window.rhombus.devices[name].mode === "none", device);
  await page.focus("#picture");
  await page.keyboard.press("Escape");
  assert.equal((await read(page, "pointer")).hold, "free");
  await close();
});

test("Shift and drag grasps the surface and pulls it out", async (t) => {
  const { page, close } = await open(browser);
  const device = await pointerDevice(page);
  if (device === null) {
    await close();
    return t.skip("no device follows the mouse in this scene");
  }
  const { x, y } = await placeOnBody(page);
  await page.keyboard.down("Shift");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(page, (name) => window.rhombus.devices[name]?.mode === "grasp", device);
  await page.mouse.move(x, y - 40, { steps: 20 });
  await until(page, (name) => {
    const { force, probe, proxy } = window.rhombus.devices[name];
    return Math.hypot(...force) > 0.05 && Math.hypot(...probe.map((part, i) => part - proxy[i])) > 0.004;
  }, device);
  await keep(page, "pulled");
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await until(page, (name) => window.rhombus.devices[name].mode !== "grasp", device);
  await close();
});

test("one page at a time holds the pointer, and the other one is told", async (t) => {
  const [one, other] = [await open(browser), await open(browser)];
  const device = await pointerDevice(one.page);
  if (device === null) {
    await one.close();
    await other.close();
    return t.skip("no device follows the mouse in this scene");
  }
  for (const { page } of [one, other]) {
    const { x, y } = await placeOnBody(page);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await until(page, () => ["ours", "refused"].includes(window.rhombus.pointer.hold));
  }
  assert.deepEqual([(await read(one.page, "pointer")).hold, (await read(other.page, "pointer")).hold], ["ours", "refused"]);
  await other.page.mouse.up();
  await one.page.mouse.up();
  await one.close();
  await other.close();
});
