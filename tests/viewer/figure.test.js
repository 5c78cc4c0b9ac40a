// A saved picture says what its colours mean and how large things are.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { artefacts, launch, open, pixels, read } from "./browser.js";
import { FakeNode } from "./fake_node.js";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const FIELD_OF_VIEW_RAD = (28 * Math.PI) / 180;

for (const [name, theme, width, height] of [["wide", "light", 1000, 640], ["phone", "dark", 400, 800]]) {
  test(`${name}, ${theme}: the saved picture has the scale of its colours and a bar of a round length`, async (t) => {
    const node = await new FakeNode({ vertices: 800 }).listen();
    const { page, close } = await open(browser, { address: node.url, width, height, theme });
    t.after(async () => {
      await close();
      await node.close();
    });
    const [download] = await Promise.all([page.waitForEvent("download"), page.evaluate(() => document.getElementById("png").click())]);
    const png = readFileSync(await download.path());
    mkdirSync(artefacts, { recursive: true });
    writeFileSync(join(artefacts, `figure-${name}-${theme}.png`), png);
    const picture = await pixels(browser, png);
    const box = await page.locator("#picture").boundingBox();
    const perCssPixel = picture.width / box.width;
    const at = (x, y) => [...picture.data.subarray(4 * (y * picture.width + x), 4 * (y * picture.width + x) + 3)];
    const near = (one, other) => one.every((part, i) => Math.abs(part - other[i]) <= 6);

    const scale = await page.evaluate(() => {
      const { data, width: steps } = document.querySelector("canvas.scale").getContext("2d").getImageData(0, 0, 256, 1);
      return Array.from({ length: steps }, (_, i) => [...data.slice(4 * i, 4 * i + 3)]);
    });
    const rows = Array.from({ length: Math.floor(picture.height / 4) }, (_, y) => y).filter((y) => {
      const row = Array.from({ length: picture.width }, (_, x) => at(x, y));
      const [first, last] = [row.findIndex((one) => near(one, scale[0])), row.findLastIndex((one) => near(one, scale.at(-1)))];
      const share = (part) => row[Math.round(first + part * (last - first))];
      return first >= 0 && last - first > 150 && [0.25, 0.5, 0.75].every((part) => near(share(part), scale[Math.round(part * 255)]));
    });
    assert.ok(rows.length > 5, `${rows.length} rows show the scale`);

    const text = (await page.evaluate(() => getComputedStyle(document.body).color)).match(/\d+/g).map(Number);
    let longest = 0;
    for (let y = Math.floor(0.75 * picture.height); y < picture.height; y += 1) {
      for (let x = Math.floor(picture.width / 3), run = 0; x < picture.width; x += 1) {
        run = near(at(x, y), text) ? run + 1 : 0;
        longest = Math.max(longest, run);
      }
    }
    const { distanceM } = await read(page, "view");
    const lengthMm = ((1000 * longest) / perCssPixel) * ((2 * distanceM * Math.tan(FIELD_OF_VIEW_RAD / 2)) / box.height);
    const round = [1, 2, 5, 10].map((one) => one * 10 ** Math.floor(Math.log10(lengthMm)));
    assert.ok(round.some((one) => Math.abs(lengthMm / one - 1) < 0.05), `a bar of ${lengthMm} mm`);
  });
}
