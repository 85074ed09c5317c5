// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// page_test.mjs TOOL TINY_PACK TEMPLATES FOLDER: pages opened as files in a headless Chromium,
// steered by its own key and touch events, held against the tool's states.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {readFileSync, statSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {Browser, sleep} from "./browser.mjs";

const [tool, pack, templates, folder] = process.argv.slice(2);
const kSeconds = 60;  // a machine without a graphics card, and busy

function exported(name, ...words) {
  const path = join(folder, name);
  execFileSync(tool, ["export", pack, "--to", "html", "-o", path, ...words], {stdio: ["ignore", "ignore", "inherit"]});
  return path;
}

function steered(keys, frames, seed = 0) {
  const words = ["steer", pack, "--keys", keys, "--frames", String(frames), "--seed", String(seed), "--json"];
  return JSON.parse(execFileSync(tool, words, {stdio: ["ignore", "pipe", "ignore"]})).states_hash;
}

async function visit(path, options, hash, act) {
  const browser = await Browser.open(pathToFileURL(path).href + hash, options);
  try {
    return await act(browser);
  } finally {
    await browser.close();
  }
}

const run = /^(\d+) ticks, states ([0-9a-f]{16})$/;
async function result(browser) {
  await browser.until("window.vsprite && vsprite.ended", kSeconds);
  const [first, second] = await browser.evaluate("vsprite.output");
  const [, ticks, states] = first.match(run);
  return {ticks: Number(ticks), states, keys: second.slice("keys ".length)};
}

async function headless(page, keys, frames, seed) {
  const words = ["--headless", "--keys", keys, "--frames", String(frames), "--seed", String(seed)];
  await visit(page, {}, "#" + words.map(encodeURIComponent).join("&"), async browser => {
    const {ticks, states} = await result(browser);
    assert.equal(ticks, frames);
    assert.equal(states, steered(keys, frames, seed));
  });
}

const tests = {
  async "a key script gives the tool's states"(page) {
    const keys = "0 right; 1.5 right+up; 2.4 none; 3 left; 4.2 down";
    await headless(page, keys, 150, 7);
  },

  async "and the run of every other door"(page) {  // tests/games/door_test.sh
    await headless(page, readFileSync(new URL("../games/door.keys", import.meta.url), "utf8"), 240, 0);
  },

  async "arrow keys and W A S D steer it, and the tool comes to the same states"(page) {
    await visit(page, {width: 960, height: 600}, "", async browser => {
      await browser.until("window.vsprite && vsprite.frames > 3", kSeconds);
      const before = await browser.screenshot(join(folder, "page-start.png"));
      await browser.key("keyDown", "ArrowRight");
      await sleep(1200);
      await browser.key("keyDown", "ArrowUp");
      await sleep(600);
      await browser.key("keyUp", "ArrowRight");
      await browser.key("keyUp", "ArrowUp");
      await browser.key("keyDown", "s");
      await sleep(800);
      const frames = await browser.evaluate("vsprite.frames"), start = Date.now();
      await sleep(2000);
      const rate = 1000 * (await browser.evaluate("vsprite.frames") - frames) / (Date.now() - start);
      console.log(`  ${rate.toFixed(1)} frames/s at 960 x 600, ` + await browser.evaluate("navigator.hardwareConcurrency") + " cores, no graphics card");
      const after = await browser.screenshot(join(folder, "page-steered.png"));
      assert.notDeepEqual(before, after);
      await browser.key("keyUp", "s");
      await browser.key("keyDown", "Escape");
      await browser.key("keyUp", "Escape");
      const {ticks, states, keys} = await result(browser);
      for (const direction of ["right", "down", "none"]) assert.match(keys, new RegExp(`\\d ${direction}\\b`));
      assert.equal(states, steered(keys, ticks), keys);
    });
  },

  async "the character goes to the finger"(page) {
    await visit(page, {width: 390, height: 700, density: 2, touch: true}, "", async browser => {
      await browser.until("window.vsprite && vsprite.frames > 3", kSeconds);
      await browser.touch("touchStart", [{x: 360, y: 350}]);
      await sleep(1500);
      await browser.screenshot(join(folder, "page-finger.png"));
      await browser.touch("touchEnd", []);
      await browser.key("keyDown", "Escape");
      const {keys} = await result(browser);
      assert.match(keys, /\d right\b/);
    });
  },

  async "without WebGL 2 the page says so in words"(page) {
    await visit(page, {webgl: false}, "", async browser => {
      await browser.until("window.vsprite && vsprite.ended", kSeconds);
      assert.match(await browser.evaluate("document.getElementById('message').textContent"), /WebGL 2 is due/);
    });
  },

  async "a game's own sources are a page: hello"() {
    const page = exported("hello.html", "--template", join(templates, "hello.html"));
    await visit(page, {width: 1280, height: 720}, "", async browser => {
      await browser.until("window.vsprite && vsprite.frames > 3", kSeconds);
      await browser.key("keyDown", "ArrowDown");
      await sleep(1000);
      await browser.screenshot(join(folder, "hello.png"));
      await browser.key("keyUp", "ArrowDown");
      await browser.key("keyDown", "Escape");
      await browser.until("vsprite.ended", kSeconds);
      assert.deepEqual(await browser.evaluate("vsprite.errors.filter(line => line.includes('error'))"), []);
    });
    console.log(`  ${(statSync(page).size / 1e6).toFixed(2)} MB`);
  },

  async "the aquarium is one page"() {
    const page = exported("aquarium.html", "--template", join(templates, "aquarium.html"));
    await visit(page, {width: 800, height: 450}, "#--quality&low", async browser => {
      await browser.until("window.vsprite && vsprite.frames > 3", kSeconds);
      await browser.key("keyDown", "ArrowRight");
      await sleep(1500);
      await browser.key("keyUp", "ArrowRight");
      await browser.screenshot(join(folder, "aquarium.png"));
      await browser.key("keyDown", "Escape");
      await browser.until("vsprite.ended", kSeconds);
      assert.deepEqual(await browser.evaluate("vsprite.errors.filter(line => line.includes('error'))"), []);
    });
    console.log(`  ${(statSync(page).size / 1e6).toFixed(2)} MB`);
  }
};

const page = exported("page.html");
console.log(`page.html: ${(statSync(page).size / 1e6).toFixed(2)} MB, of which the pack ${(statSync(pack).size / 1e6).toFixed(2)}`);
let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  const start = Date.now();
  try {
    await test(page);
    console.log(`ok      ${name}, ${((Date.now() - start) / 1000).toFixed(1)} s`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}: ${error.stack}`);
  }
}
process.exit(failed ? 1 : 0);
