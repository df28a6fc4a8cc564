/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page in headless Chromium, driven over its debugging pipe: no package is needed. */
"use strict";
const { spawn, execFileSync } = require("child_process"),
  fs = require("fs"),
  os = require("os"),
  path = require("path");

function find() {
  for (const name of ["chromium", "chromium-browser", "google-chrome"])
    try {
      return execFileSync("which", [name], { encoding: "utf8" }).trim();
    } catch (e) {
      /* try the next one */
    }
  return null;
}

class Browser {
  constructor() {
    this.home = fs.mkdtempSync(path.join(os.tmpdir(), "graingas-page-"));
    this.child = spawn(
      find(),
      [
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--no-first-run",
        "--remote-debugging-pipe",
        "--disable-extensions",
        "--disable-background-networking",
        "--enable-precise-memory-info",
        `--user-data-dir=${this.home}`,
        "about:blank",
      ],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] },
    );
    this.waiting = new Map();
    this.listeners = [];
    this.count = 0;
    let rest = "";
    this.child.stdio[4].setEncoding("utf8").on("data", (chunk) => {
      const parts = (rest + chunk).split("\0");
      rest = parts.pop();
      for (const part of parts) this.take(JSON.parse(part));
    });
  }
  take(message) {
    const one = this.waiting.get(message.id);
    if (!one) {
      for (const listener of this.listeners) listener(message);
      return;
    }
    this.waiting.delete(message.id);
    if (message.error) one.reject(new Error(message.error.message));
    else one.resolve(message.result);
  }
  send(method, params = {}, sessionId = undefined) {
    const id = ++this.count;
    this.child.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  async close() {
    const gone = new Promise((resolve) => this.child.on("exit", resolve));
    this.send("Browser.close").catch(() => {});
    await gone;
    fs.rmSync(this.home, { recursive: true, force: true, maxRetries: 5 });
  }

  /* Open the file in a tab, in a window of this size; its console messages are kept in `said`. */
  async open(file, { width = 1366, height = 768, hash = "", media = [], scale = 1, url = `file://${file}${hash}` } = {}) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const tab = new Tab(this, sessionId, targetId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await tab.send(`${domain}.enable`);
    await tab.send("Emulation.setDeviceMetricsOverride", {
      width,
      height,
      deviceScaleFactor: scale,
      mobile: width < 600,
    });
    if (media.length) await tab.send("Emulation.setEmulatedMedia", { features: media });
    await tab.send("Page.navigate", { url });
    return tab;
  }
}

class Tab {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target, said: [], fetched: [] });
    browser.listeners.push((m) => {
      if (m.sessionId !== session) return;
      if (m.method === "Runtime.consoleAPICalled")
        this.said.push(m.params.args.map((a) => a.value || a.description).join(" "));
      if (m.method === "Runtime.exceptionThrown")
        this.said.push(JSON.stringify(m.params.exceptionDetails).slice(0, 900));
      if (m.method === "Log.entryAdded") this.said.push(m.params.entry.text);
      if (m.method === "Network.requestWillBeSent") this.fetched.push(m.params.request.url);
    });
  }
  send(method, params) {
    return this.browser.send(method, params, this.session);
  }
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression,
      awaitPromise: true,
      returnByValue: true,
    });
    if (exceptionDetails)
      throw new Error(exceptionDetails.exception ? exceptionDetails.exception.description : exceptionDetails.text);
    return result.value;
  }
  /* Wait until the expression is true, or so many seconds have passed. */
  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; ; await new Promise((r) => setTimeout(r, 100))) {
      const value = await this.value(expression);
      if (value) return value;
      if (Date.now() > end) throw new Error(`after ${seconds} s still not: ${expression}`);
    }
  }
  async press(key) {
    const windowsVirtualKeyCode = { Home: 36, ArrowRight: 39, Enter: 13 }[key] || key.toUpperCase().charCodeAt(0);
    for (const type of ["keyDown", "keyUp"])
      await this.send("Input.dispatchKeyEvent", { type, key, code: key, windowsVirtualKeyCode });
  }
  /* Choose a file for an input, as the user does in its dialogue. */
  async choose(selector, file) {
    const { root } = await this.send("DOM.getDocument", {});
    const { nodeId } = await this.send("DOM.querySelector", { nodeId: root.nodeId, selector });
    await this.send("DOM.setFileInputFiles", { nodeId, files: [file] });
  }
  async picture(file) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: false });
    fs.writeFileSync(file, Buffer.from(data, "base64"));
  }
  close() {
    return this.browser.send("Target.closeTarget", { targetId: this.target });
  }
}

module.exports = { find, Browser };
