// A headless Chromium that looks at the page, notes what it complains about and keeps pictures.
//
// RHOMBUS_VIEWER_URL        the page's address; needed, except where a test brings its own node
// RHOMBUS_CHROMIUM          the browser; /usr/bin/chromium if not said
// RHOMBUS_VIEWER_PATIENCE_MS  how long anything may take before it counts as missing; 120000 if not said
// RHOMBUS_VIEWER_ARTEFACTS  folder for pictures; artefacts/ beside this file if not said

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";

export const url = process.env.RHOMBUS_VIEWER_URL;
const executablePath = process.env.RHOMBUS_CHROMIUM ?? "/usr/bin/chromium";
export const artefacts = process.env.RHOMBUS_VIEWER_ARTEFACTS ?? join(import.meta.dirname, "artefacts");

const ARGUMENTS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
  // WebGL without a graphics card.
  "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

/** Time that a busy machine may need for a first picture, ms. */
const PATIENCE_MS = Number(process.env.RHOMBUS_VIEWER_PATIENCE_MS ?? 120_000);

export async function launch() {
  return chromium.launch({ executablePath, args: ARGUMENTS });
}

/**
 * Opens the page, runs `script` in it before its own, and waits for its first picture, or only for its script when it is not to be
 * `drawn`. `close` fails when the page wrote an error to its console.
 */
export async function open(browser, options = {}) {
  const { address = url, width = 1280, height = 720, theme = "light", touch = false, script = null, drawn = true } = options;
  assert.ok(address, "RHOMBUS_VIEWER_URL is not set: the address of the page to look at, such as http://127.0.0.1:8080/");
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: theme,
    hasTouch: touch,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  if (script) await page.addInitScript(script);
  const errors = [];
  page.on("console", (message) => {
    if (message.type() === "error") errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  const foreign = [];
  page.on("request", (request) => {
    if (new URL(request.url()).host !== new URL(address).host && !request.url().startsWith("blob:")) foreign.push(request.url());
  });
  await page.goto(address);
  await page.waitForFunction((one) => window.rhombus && (!one || window.rhombus.first_picture_ms !== null), drawn);
  const close = async () => {
    await context.close();
    assert.deepEqual(errors, [], "errors in the page's console");
    assert.deepEqual(foreign, [], "requests to other hosts");
  };
  return { page, errors, close };
}

/** Keeps a picture of the page and returns it. */
export async function keep(page, name) {
  mkdirSync(artefacts, { recursive: true });
  const png = await page.screenshot({ timeout: PATIENCE_MS });
  writeFileSync(join(artefacts, `${name}.png`), png);
  return png;
}

/** Keeps what the page knows, for whoever compares it with the topics. */
export function note(name, facts) {
  mkdirSync(artefacts, { recursive: true });
  writeFileSync(join(artefacts, `${name}.json`), JSON.stringify(facts));
}

/** Width, height and RGBA bytes of a PNG, read by the browser itself. */
export async function pixels(browser, png) {
  const page = await browser.newPage();
  const { width, height, text } = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let binary = "";
    for (let i = 0; i < data.length; i += 32768) binary += String.fromCharCode(...data.subarray(i, i + 32768));
    return { width: bitmap.width, height: bitmap.height, text: btoa(binary) };
  }, png.toString("base64"));
  await page.close();
  return { width, height, data: Buffer.from(text, "base64") };
}

/** What the page knows, copied out of it. */
export const read = (page, expression) => page.evaluate(`JSON.parse(JSON.stringify(window.rhombus.${expression} ?? null))`);

/** Waits until a function of the page's `rhombus` says yes; otherwise the error says what the page knew. */
export async function until(page, condition, argument) {
  try {
    await page.waitForFunction(condition, argument, { polling: 50 });
  } catch (error) {
    const known = await page.evaluate(() => {
      const { connection, counters, devices, pointer, status } = window.rhombus;
      return JSON.stringify({ connection, counters, devices, pointer, told: status?.devices });
    });
    throw new Error(`${error.message}\n${condition}\nThe page knew ${known}`);
  }
}

/** A place on the screen where the body is seen, near the middle of the picture. */
export async function placeOnBody(page) {
  const place = await page.evaluate(() => {
    const { left, top, width, height } = document.getElementById("picture").getBoundingClientRect();
    const places = [];
    for (let x = 0.25; x < 0.76; x += 0.05) {
      for (let y = 0.2; y < 0.8; y += 0.05) {
        const hit = window.rhombus.pick(x * width, y * height);
        // A face that looks at the viewer, where nothing of the page lies over it.
        const over = document.elementFromPoint(left + x * width, top + y * height)?.id !== "picture";
        if (hit && !over) places.push({ x: left + x * width, y: top + y * height, hit, off: Math.abs(x - 0.5) + Math.abs(y - 0.45) - 0.3 * hit.normal[2] });
      }
    }
    return places.sort((one, other) => one.off - other.off)[0] ?? null;
  });
  assert.ok(place, "the body is nowhere in the picture");
  return place;
}
