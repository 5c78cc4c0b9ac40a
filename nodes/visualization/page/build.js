// Builds dist/ from src/: the same bytes from the same sources and lock file, so that a check can compare.
// `node build.js --tests` bundles the unit tests for node instead; nothing of them is kept in the repository.

import { readFileSync, readdirSync, rmSync, mkdirSync, writeFileSync, copyFileSync } from "node:fs";
import { build } from "esbuild";

process.chdir(import.meta.dirname);
if (process.argv.includes("--tests")) await buildTests();
else await buildPage();

async function buildTests() {
  rmSync("build", { recursive: true, force: true });
  const tests = readdirSync("test").filter((name) => name.endsWith(".test.ts"));
  await build({
    entryPoints: tests.map((name) => `test/${name}`),
    outdir: "build",
    bundle: true,
    platform: "node",
    format: "esm",
    outExtension: { ".js": ".mjs" },
    logLevel: "warning",
  });
}

async function buildPage() {
  rmSync("dist", { recursive: true, force: true });
  mkdirSync("dist");
  await build({
    entryPoints: { viewer: "src/main.ts", link: "src/link_worker.ts" },
    outdir: "dist",
    bundle: true,
    minify: true,
    format: "esm",
    target: ["chrome123", "firefox120", "safari17.5"],
    legalComments: "none",
    charset: "utf8",
    define: { PAGE_VERSION: JSON.stringify(JSON.parse(readFileSync("package.json", "utf8")).version) },
    logLevel: "warning",
  });
  copyFileSync("src/index.html", "dist/index.html");
  copyFileSync("src/icon.svg", "dist/icon.svg");
  writeFileSync("dist/LICENCES.txt", licences(["three", "uplot"]));
}

/** The licences of everything that is bundled. */
function licences(packages) {
  const texts = packages.map((name) => {
    const { version, license } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
    const text = readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim();
    return `${name} ${version} (${license})\n\n${text}\n`;
  });
  const own = "The page itself is part of Rhombus Haptics: MIT OR Apache-2.0. It contains:\n";
  return [own, ...texts].join(`\n${"-".repeat(72)}\n\n`);
}
