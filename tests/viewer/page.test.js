// What a visitor sees and does, whatever serves the page.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { keep, launch, open, pixels, placeOnBody, read, until } from "./browser.js";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** Runs the checks of axe-core; returns what is serious or worse. */
async function seriousFindings(page) {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations
      .filter(({ impact }) => impact === "serious" || impact === "critical")
      .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(" ")).join(", ")}`);
  });
}

test("the page draws a body: shaded, not empty, where its vertices are", async (t) => {
  const { page, close } = await open(browser);
  const [mesh, renderer, first] = [await read(page, "mesh"), await read(page, "renderer"), await read(page, "first_picture_ms")];
  t.diagnostic(`${mesh.vertices} vertices, ${renderer}, first picture after ${first.toFixed(0)} ms`);
  assert.ok(mesh.vertices > 0 && mesh.triangles > 0);
  const { left, top } = await page.locator("#picture").boundingBox().then(({ x, y }) => ({ left: x, top: y }));
  const { hit } = await placeOnBody(page);
  const at = await page.evaluate((point) => window.rhombus.project(point), hit.point);
  const { width, data } = await pixels(browser, await keep(page, "body"));
  const colour = (x, y) => [...data.subarray(4 * (Math.round(y) * width + Math.round(x)), 4 * (Math.round(y) * width + Math.round(x)) + 3)];
  const box = await page.locator("#picture").boundingBox();
  const background = colour(box.x + box.width - 8, box.y + box.height / 2);
  const differs = (one) => Math.max(...one.map((part, i) => Math.abs(part - background[i]))) > 24;
  assert.ok(differs(colour(left + at.x, top + at.y)), "a point of the body has the colour of the background");
  let drawn = 0;
  const colours = new Set();
  for (let y = box.y + 4; y < box.y + box.height - 4; y += 2) {
    for (let x = box.x + 4; x < box.x + box.width - 4; x += 2) {
      const one = colour(x, y);
      if (!differs(one)) continue;
      drawn += 1;
      colours.add(one.join());
    }
  }
  const share = drawn / ((box.width * box.height) / 4);
  assert.ok(share > 0.05, `only ${(100 * share).toFixed(1)} % of the picture is not background`);
  assert.ok(colours.size > 60, `only ${colours.size} colours: not shaded`);
  await close();
});

test("states and surfaces arrive and are applied; nothing is garbage", async (t) => {
  const { page, close } = await open(browser);
  const before = await page.evaluate(() => ({ ...window.rhombus.counters, ms: performance.now() }));
  await page.waitForTimeout(2000);
  const now = await page.evaluate(() => ({ ...window.rhombus.counters, ms: performance.now() }));
  const perSecond = (key) => ((now[key] - before[key]) / (now.ms - before.ms)) * 1000;
  t.diagnostic(`received ${perSecond("received").toFixed(1)}/s, applied ${perSecond("applied").toFixed(1)}/s, pictures ${perSecond("pictures").toFixed(1)}/s`);
  assert.ok(perSecond("states") >= 2, "states come at 4 Hz or more, even when nothing moves");
  assert.equal(now.applied, now.received);
  assert.deepEqual([now.garbage, now.outOfOrder, now.otherMesh, now.refusedByNode], [0, 0, 0, 0]);
  assert.equal((await read(page, "connection")).phase, "connected");
  await close();
});

for (const [name, width, height] of [["phone", 400, 800], ["wide", 1280, 720], ["uhd", 3840, 2160]]) {
  test(`${name}: in both themes nothing overflows, nothing overlaps, axe-core has no serious finding`, async () => {
    const { page, close } = await open(browser, { width, height, theme: "light" });
    for (const theme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme: theme });
      await page.waitForFunction((one) => document.documentElement.dataset.theme === one, theme);
      await page.waitForTimeout(700);
      await keep(page, `${name}-${theme}`);
      const { scroll, client } = await page.evaluate(() => ({
        scroll: document.documentElement.scrollWidth,
        client: document.documentElement.clientWidth,
      }));
      assert.ok(scroll <= client, `${scroll} px of content in ${client} px`);
      const overlaps = await page.evaluate(() => {
        const boxes = [...document.querySelectorAll(".legend, .view-buttons, #hand, .timeline, .axes-block, .scale-bar, .bar")]
          .map((element) => ({ name: element.id || element.className, ...element.getBoundingClientRect().toJSON() }))
          .filter(({ width: w, height: h }) => w > 0 && h > 0);
        const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        return boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => meet(a, b)).map((b) => `${a.name} and ${b.name}`));
      });
      assert.deepEqual(overlaps, []);
      // Letters that can be read: 11 px at least, and larger on a large screen.
      const rem = await page.evaluate(() => parseFloat(getComputedStyle(document.documentElement).fontSize));
      assert.ok(rem >= (width > 3000 ? 20 : 14), `${rem} px`);
      assert.deepEqual(await seriousFindings(page), [], theme);
    }
    await close();
  });
}

test("the dialog of the keys is accessible and closes with Escape", async () => {
  const { page, close } = await open(browser, { width: 400, height: 800 });
  await page.click("#help");
  await keep(page, "keys");
  assert.deepEqual(await seriousFindings(page), []);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#keys[open]").count(), 0);
  await close();
});

test("two pages at once see the same body and both stay live", async () => {
  const [one, other] = [await open(browser), await open(browser, { width: 800, height: 600, theme: "dark" })];
  const meshes = [await read(one.page, "mesh"), await read(other.page, "mesh")];
  assert.deepEqual(meshes[0], meshes[1]);
  await until(one.page, () => (window.rhombus.status?.pages ?? 0) >= 2);
  for (const { page } of [one, other]) {
    const states = (await read(page, "counters")).states;
    await until(page, (before) => window.rhombus.counters.states > before + 2, states);
  }
  await one.close();
  await other.close();
});

test("the theme switches, and the picture with it", async () => {
  const { page, close } = await open(browser, { theme: "light" });
  const corner = async () => {
    const box = await page.locator("#picture").boundingBox();
    const { width, data } = await pixels(browser, await page.screenshot());
    return data[4 * (Math.round(box.y + box.height / 2) * width + Math.round(box.x + box.width - 8))];
  };
  const light = await corner();
  await page.click("#theme");
  assert.equal(await page.locator("html").getAttribute("data-theme"), "dark");
  await page.waitForTimeout(800);
  const dark = await corner();
  assert.ok(light > 180 && dark < 80, `${light} and ${dark}`);
  await page.reload();
  assert.equal(await page.locator("html").getAttribute("data-theme"), "dark", "the choice is remembered");
  await close();
});

test("the picture is saved as PNG with at least the pixels of the screen", async () => {
  const { page, close } = await open(browser);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#png")]);
  assert.match(download.suggestedFilename(), /^rhombus-[0-9T-]+\.png$/);
  const { width, height, data } = await pixels(browser, readFileSync(await download.path()));
  const box = await page.locator("#picture").boundingBox();
  assert.ok(width >= Math.floor(box.width) && height >= Math.floor(box.height), `${width} x ${height}`);
  const colours = new Set();
  for (let i = 0; i < data.length; i += 4 * 97) colours.add(data.readUInt32LE(i));
  assert.ok(colours.size > 30, `${colours.size} colours`);
  await close();
});

test("the plotted window is saved as CSV: names with units, a row for each state, times in order", async () => {
  const { page, close } = await open(browser);
  await page.waitForTimeout(2000);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#csv")]);
  const lines = readFileSync(await download.path(), "utf8").trim().split("\n");
  const names = lines[0].split(",");
  assert.deepEqual(names.slice(0, 2), ["time_s", "seconds_before_end"]);
  for (const unit of ["depth_mm", "applied_force_n", "commanded_force_n", "rate_hz", "latency_ms", "missed_deadlines_per_s"]) {
    assert.ok(names.some((name) => name.endsWith(unit)), unit);
  }
  assert.ok(lines.length > 4, `${lines.length} lines`);
  const ago = lines.slice(1).map((line) => Number(line.split(",")[1]));
  assert.ok(ago.every((value, i) => value >= 0 && value <= 60.5 && (i === 0 || value <= ago[i - 1])));
  assert.ok(lines.every((line) => line.split(",").length === names.length && !/nan|inf/i.test(line)));
  await close();
});

test("looking back shows an earlier moment and stays there; Live returns", async () => {
  const { page, close } = await open(browser);
  await page.waitForTimeout(2000);
  const slider = page.getByLabel("Look back, seconds before now");
  await slider.fill("-1");
  await until(page, () => window.rhombus.lookingBackS === 1);
  const moved = await read(page, "moved");
  const applied = (await read(page, "counters")).applied;
  await page.waitForTimeout(600);
  assert.deepEqual(await read(page, "moved"), moved, "the surface stays while somebody looks back");
  assert.equal((await read(page, "counters")).applied, applied);
  await keep(page, "looking-back");
  await page.getByRole("button", { name: "Live" }).click();
  await until(page, () => window.rhombus.lookingBackS === 0);
  await close();
});

test("the view turns, moves, zooms and comes back, with mouse, wheel and keys", async () => {
  const { page, close } = await open(browser);
  const home = await read(page, "view");
  const { x, y } = await placeOnBody(page);
  await page.mouse.move(x, y);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(x + 60, y + 20, { steps: 4 });
  await page.mouse.up({ button: "right" });
  const turned = await read(page, "view");
  assert.ok(turned.azimuthRad !== home.azimuthRad && turned.elevationRad !== home.elevationRad);
  await page.mouse.wheel(0, -300);
  await until(page, (before) => window.rhombus.view.distanceM < before, turned.distanceM);
  await page.mouse.down({ button: "middle" });
  await page.mouse.move(x + 90, y, { steps: 4 });
  await page.mouse.up({ button: "middle" });
  assert.notDeepEqual((await read(page, "view")).target, home.target);
  await page.focus("#picture");
  await page.keyboard.press("r");
  assert.deepEqual(await read(page, "view"), home);
  await page.keyboard.press("ArrowLeft");
  assert.ok((await read(page, "view")).azimuthRad !== home.azimuthRad);
  for (const [key, quantity] of [["2", "force"], ["3", "stiffness"], ["1", "displacement"]]) {
    await page.keyboard.press(key);
    assert.equal(await page.locator("input[name=quantity]:checked").inputValue(), quantity);
    assert.match(await page.locator("canvas.scale").getAttribute("aria-label"), quantity === "force" ? / N$/ : / (mm|N\/mm|× law)$/);
  }
  await close();
});

test("two fingers zoom and turn on a phone", async () => {
  const { page, close } = await open(browser, { width: 400, height: 800, touch: true });
  const before = await read(page, "view");
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  const pair = (gap) => [{ x: 200 - gap, y: 260, id: 1 }, { x: 200 + gap, y: 260, id: 2 }];
  await touch("touchStart", pair(30).slice(0, 1));
  await touch("touchStart", pair(30));
  for (let gap = 35; gap <= 90; gap += 5) await touch("touchMove", pair(gap));
  await touch("touchEnd", []);
  await until(page, (distance) => window.rhombus.view.distanceM < 0.8 * distance, before.distanceM);
  await close();
});

test("the side panel closes and opens, and the picture takes its place", async () => {
  const { page, close } = await open(browser);
  const width = (await page.locator("#picture").boundingBox()).width;
  await page.click("#panel-toggle");
  assert.equal(await page.locator("#panel-toggle").getAttribute("aria-expanded"), "false");
  assert.ok((await page.locator("#picture").boundingBox()).width > width + 200);
  await page.click("#panel-toggle");
  assert.equal((await page.locator("#picture").boundingBox()).width, width);
  await close();
});
