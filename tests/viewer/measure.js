// What the page gets and applies, counted in the page: `node measure.js SECONDS`. Prints one line of JSON; then, when the
// page says that a publisher is gone, a second one with the time of day.

import { launch, open, read, until } from "./browser.js";

const SURFACE = 2;
/** Surfaces whose stamps are farther apart than this are not of one motion: the hand rested or had lifted off. s */
const ONE_MOTION_S = 0.1;

/** In the page: stamp of every surface that its thread gets, and when it does, s. The socket is a worker's. */
function noteSurfaces(surface) {
  window.surfaces = [];
  window.Worker = class extends Worker {
    constructor(...source) {
      super(...source);
      this.addEventListener("message", ({ data }) => {
        const view = data.type === "binary" ? new DataView(data.buffer) : null;
        if (view?.getUint8(0) === surface) window.surfaces.push([view.getFloat64(16, true), Date.now() / 1000]);
      });
    }
  };
}

const seconds = Number(process.argv[2] ?? 12);
const browser = await launch();
const { page, close } = await open(browser, { script: `(${noteSurfaces})(${SURFACE})` });
const firstPictureMs = await read(page, "first_picture_ms");
await until(page, () => window.rhombus.moved.length > 0);
const sample = () => page.evaluate(() => ({ s: performance.now() / 1000, surfaces: window.surfaces.length, ...window.rhombus.counters }));
const first = await sample();
await page.waitForTimeout(1000 * seconds);
const last = await sample();
const surfaces = await page.evaluate(([from, to]) => window.surfaces.slice(from, to), [first.surfaces, last.surfaces]);

// While the surface moves one update follows the other.
const pauses = surfaces.slice(1).map(([stamp], i) => stamp - surfaces[i][0]).filter((pause) => pause < ONE_MOTION_S);
const ages = surfaces.map(([stamp, arrived]) => arrived - stamp).sort((a, b) => a - b);
const received = last.received - first.received;
const applied = last.applied - first.applied;
const receivedHz = pauses.length / pauses.reduce((sum, pause) => sum + pause, 0);
console.log(JSON.stringify({
  first_picture_ms: firstPictureMs,
  received_hz: receivedHz,
  applied_hz: (receivedHz * applied) / received,
  not_applied: received - applied,
  dropped: last.dropped,
  age_ms: 1000 * ages[Math.floor(ages.length / 2)],
  pictures_hz: (last.pictures - first.pictures) / (last.s - first.s),
  renderer: await read(page, "renderer"),
}));
await page.waitForFunction(() => document.body.innerText.includes("Nothing comes on contact_state"), null, { polling: 10 });
console.log(JSON.stringify({ gone_at_s: Date.now() / 1000 }));
await close();
await browser.close();
