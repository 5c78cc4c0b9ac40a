// What the page gets and applies, counted in the page: `node measure.js SECONDS`. Prints one line of JSON; then, when the
// page says that a publisher is gone, a second one with the time of day.

import { launch, open, read, until } from "./browser.js";

const seconds = Number(process.argv[2] ?? 12);
const browser = await launch();
const { page, close } = await open(browser);
const firstPictureMs = await read(page, "first_picture_ms");
// A surface that moves: while the hand touches, one update follows the other.
await until(page, () => window.rhombus.moved.length > 0);
const sample = async () => ({ at: Date.now(), ...(await read(page, "counters")) });
const samples = [await sample()];
while (samples.at(-1).at - samples[0].at < 1000 * seconds) {
  await page.waitForTimeout(500);
  samples.push(await sample());
}
const windows = samples.slice(1).map((now, i) => {
  const before = samples[i];
  const elapsed = (now.at - before.at) / 1000;
  return { received: (now.received - before.received) / elapsed, applied: (now.applied - before.applied) / elapsed };
});
const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
// Half a second in which the hand lifts off has fewer updates: of all windows the one in the middle counts.
const [first, last] = [samples[0], samples.at(-1)];
console.log(JSON.stringify({
  first_picture_ms: firstPictureMs,
  received_hz: middle(windows.map((one) => one.received)),
  applied_hz: middle(windows.map((one) => one.applied)),
  not_applied: last.received - last.applied,
  dropped: last.dropped,
  pictures_hz: (last.pictures - first.pictures) / ((last.at - first.at) / 1000),
  renderer: await read(page, "renderer"),
}));
await page.waitForFunction(() => document.body.innerText.includes("Nothing comes on contact_state"), null, { polling: 10 });
console.log(JSON.stringify({ gone_at_s: Date.now() / 1000 }));
await close();
await browser.close();
