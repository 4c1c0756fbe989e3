// Chromium without a window, driven by the DevTools protocol through a pipe, with SwiftShader in place of a GPU.
import { spawn } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

export class Chromium {
  constructor(width, height) {
    this.profile = mkdtempSync(join(tmpdir(), "nook-web-"));
    this.process = spawn(process.env.NOOK_CHROMIUM ?? "chromium", ["--headless=new", "--no-sandbox", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
      "--hide-scrollbars", "--disable-dev-shm-usage", "--disable-renderer-backgrounding", "--disable-background-timer-throttling",
      `--user-data-dir=${this.profile}`, `--window-size=${width},${height}`, "--remote-debugging-pipe", "about:blank"],
    { stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"] });
    this.log = "";
    this.process.stderr.on("data", (text) => (this.log = (this.log + text).slice(-20000)));
    this.gone = new Promise((resolve) => this.process.on("exit", resolve));
    this.waiting = new Map();
    this.console = [];  // errors and warnings of the page
    this.last = 0;
    let rest = "";
    this.process.stdio[4].on("data", (bytes) => {
      const parts = (rest + bytes).split("\0");
      rest = parts.pop();
      for (const part of parts) this.#receive(JSON.parse(part));
    });
    this.process.on("exit", () => {
      for (const { reject } of this.waiting.values()) reject(new Error(`Chromium ended\n${this.log}`));
    });
  }

  #receive(message) {
    const waiting = this.waiting.get(message.id);
    if (waiting) {
      this.waiting.delete(message.id);
      if (message.error) waiting.reject(new Error(message.error.message));
      else waiting.resolve(message.result);
      return;
    }
    const { method, params } = message;
    if (method === "Runtime.exceptionThrown")
      this.console.push(`exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
      this.console.push(`console.${params.type}: ${params.args.map((arg) => arg.value ?? arg.description).join(" ")}`);
    if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level))
      this.console.push(`${params.entry.source}: ${params.entry.text} ${params.entry.url ?? ""}`);
  }

  send(method, params = {}, session = this.session) {
    const id = ++this.last;
    const sent = new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: session })}\0`);
    return sent;
  }

  // Opens the address in a page with this size in pixels.
  async open(url, width, height) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" }, undefined);
    this.session = (await this.send("Target.attachToTarget", { targetId, flatten: true }, undefined)).sessionId;
    for (const domain of ["Runtime", "Log", "Page"]) await this.send(`${domain}.enable`);
    await this.size(width, height);
    await this.send("Page.navigate", { url });
  }

  size(width, height) {
    return this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  }

  // Returns the value of an expression in the page. Waits for promises.
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async until(expression, seconds) {
    const end = Date.now() + 1000 * seconds;
    while (Date.now() < end) {
      if (await this.evaluate(expression).catch(() => false)) return;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error(`${expression} did not become true in ${seconds} s\n${this.console.join("\n")}\n${this.log.slice(-2000)}`);
  }

  async screenshot() {
    return Buffer.from((await this.send("Page.captureScreenshot", { format: "png" })).data, "base64");
  }

  async close() {
    // Other processes of Chromium may outlive the first one for a while, and write into the profile.
    this.process.kill();
    await this.gone;
    await rm(this.profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
  }
}
