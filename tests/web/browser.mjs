// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// browser.mjs - a headless Chromium with one page, driven by the DevTools protocol over a pipe.
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

const kChromium = process.env.CHROMIUM || "chromium";
const kQuiet = ["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking",
                "--disable-component-update", "--disable-sync", "--disable-quic", "--disable-extensions",
                "--mute-audio", "--hide-scrollbars"];
const kSoftwareGl = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export const sleep = ms => new Promise(done => setTimeout(done, ms));

export class Browser {
  /// `options`: width, height, density (pixels a CSS pixel), touch, webgl (true).
  static async open(url, options = {}) {
    const {width = 800, height = 600, density = 1, touch = false, webgl = true} = options;
    const browser = new Browser();
    browser.folder = mkdtempSync(join(tmpdir(), "vsprite-web-"));
    browser.process = spawn(kChromium, [
      ...kQuiet, ...(webgl ? kSoftwareGl : ["--disable-gpu", "--disable-3d-apis"]),
      `--user-data-dir=${browser.folder}`, `--window-size=${width},${height}`,
      "--remote-debugging-pipe", "about:blank"
    ], {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
    browser.listen();
    const {targetInfos} = await browser.send("Target.getTargets", {}, null);
    const {targetId} = targetInfos.find(target => target.type === "page");
    browser.session = (await browser.send("Target.attachToTarget", {targetId, flatten: true}, null)).sessionId;
    await browser.send("Emulation.setDeviceMetricsOverride",
                       {width, height, deviceScaleFactor: density, mobile: touch});
    if (touch) await browser.send("Emulation.setTouchEmulationEnabled", {enabled: true});
    await browser.send("Page.enable");
    await browser.send("Page.navigate", {url});
    return browser;
  }

  listen() {
    this.waiting = new Map();
    this.count = 0;
    const [, , , input, output] = this.process.stdio;
    this.input = input;
    let text = "";
    output.setEncoding("utf8");
    output.on("data", part => {
      const messages = (text + part).split("\0");
      text = messages.pop();
      for (const message of messages) this.receive(JSON.parse(message));
    });
    this.process.on("exit", code => {
      for (const {failed} of this.waiting.values()) failed(new Error(`the browser ended with ${code}`));
    });
  }

  receive({id, result, error}) {
    const call = this.waiting.get(id);
    if (!call) return;
    this.waiting.delete(id);
    if (error) call.failed(new Error(error.message));
    else call.done(result);
  }

  send(method, params = {}, sessionId = this.session) {
    const id = ++this.count;
    return new Promise((done, failed) => {
      this.waiting.set(id, {done, failed});
      this.input.write(JSON.stringify({id, method, params, ...(sessionId && {sessionId})}) + "\0");
    });
  }

  async evaluate(expression) {
    const {result, exceptionDetails} =
        await this.send("Runtime.evaluate", {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }

  async until(expression, seconds = 30) {
    const end = Date.now() + 1000 * seconds;
    while (Date.now() < end) {
      const value = await this.evaluate(expression);
      if (value) return value;
      await sleep(50);
    }
    throw new Error(`waited ${seconds} s for ${expression}; the page says: ` +
                    await this.evaluate("JSON.stringify(window.vsprite || document.body.innerText)"));
  }

  async key(type, key) {  // type: keyDown or keyUp
    const letter = /^[a-z]$/.test(key);
    await this.send("Input.dispatchKeyEvent",
                    {type, key, code: letter ? "Key" + key.toUpperCase() : key, ...(letter && type === "keyDown" && {text: key}),
                     windowsVirtualKeyCode: letter ? key.toUpperCase().charCodeAt(0) : 0});
  }

  async touch(type, points) {  // type: touchStart, touchMove or touchEnd; points: [{x, y}]
    await this.send("Input.dispatchTouchEvent", {type, touchPoints: points});
  }

  async screenshot(path) {
    const {data} = await this.send("Page.captureScreenshot", {format: "png"});
    const bytes = Buffer.from(data, "base64");
    if (path) writeFileSync(path, bytes);
    return bytes;
  }

  async close() {
    const gone = new Promise(done => this.process.on("exit", done));
    this.send("Browser.close", {}, null).catch(() => {});
    await Promise.race([gone, sleep(5000)]);
    if (this.process.exitCode === null) this.process.kill("SIGKILL");
    // The browser's children write there until they have ended as well.
    for (let tries = 0; tries < 50; ++tries) {
      try {
        rmSync(this.folder, {recursive: true, force: true});
        break;
      } catch {
        await sleep(100);
      }
    }
  }
}
