// Tests the page with missing, cut-off or forbidden files, in lost contexts, with keys and on a small screen: node
// faults_test.mjs SITE
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { Chromium } from "./chromium.mjs";
import { types } from "./serve.mjs";

const site = process.argv[2];
let fault = {}, failures = 0;
const expect = (right, text) => {
  console.log(`${right ? "  " : "! "}${text}`);
  failures += !right;
};
const server = createServer((request, response) => {
  const { pathname } = new URL(request.url, "http://localhost"), path = pathname === "/" ? "/index.html" : pathname;
  let bytes = null;
  try {
    if (fault.missing !== path) bytes = readFileSync(join(site, path));
  } catch {}
  if (!bytes) return response.writeHead(404).end();
  if (fault.cut === path) bytes = bytes.subarray(0, bytes.length >> 1);
  response.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream",
    ...(fault.policy ? { "Content-Security-Policy": fault.policy } : {}) });
  return response.end(bytes);
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const url = `http://127.0.0.1:${server.address().port}/`;
const chromium = new Chromium(640, 400);
const said = "document.getElementById('message').hidden ? '' : document.getElementById('message_text').textContent";
const open = async (query, width, height) => {
  await chromium.open(url + query, width, height);
  await chromium.until("!!window.nookPage || document.getElementById('message')?.classList.contains('error')", 60);
};
try {
  const wasm = "/node_modules/nook-web/nook.wasm";
  for (const [made, words] of [[{ missing: "/main.js" }, /main\.js/], [{ missing: "/sky.js" }, /script of the page/], [{ cut: "/main.js" }, /script of the page/],
    [{ missing: wasm }, /nook\.wasm .*404/], [{ cut: wasm }, /nook\.wasm/], [{ missing: "/data/character.bin" }, /character\.bin cannot be fetched/],
    [{ cut: "/data/character.bin" }, /character\.bin is incomplete/], [{ cut: "/data/character.json" }, /character\.json is damaged/],
    [{ cut: "/data/character.nook" }, /character\.nook: /], [{ cut: "/data/material.nook" }, /material\.nook: /],
    [{ missing: "/data/showcase.bin" }, /showcase\.bin cannot be fetched/], [{ cut: "/data/showcase.bin" }, /showcase\.bin is incomplete/],
    [{ policy: "default-src 'self'" }, /wasm-unsafe-eval/], [{ policy: "default-src 'self' 'wasm-unsafe-eval'; connect-src 'none'" }, /content security policy/]]) {
    fault = made;
    await open("", 640, 400);
    const sentence = await chromium.evaluate(said);
    expect(words.test(sentence), `${JSON.stringify(made)}: ${sentence}`);
  }
  // If no script of the page runs, the sentence of index.html stays.
  for (const made of [{ missing: "/start.js" }, { policy: "script-src 'none'" }]) {
    fault = made;
    await chromium.open(url, 640, 400);
    await chromium.until("document.readyState === 'complete' && !!document.getElementById('message')", 20);
    expect(/scripts are missing or blocked/.test(await chromium.evaluate(said)), `${JSON.stringify(made)}: the sentence stays`);
  }
  fault = { policy: "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src data:" };
  await open("", 640, 400);
  expect(await chromium.evaluate(said) === "", "a strict policy that allows WebAssembly shows the picture");

  fault = {};
  await open("?check&count=0&neighbours=-1", 390, 700);
  const state = JSON.parse(await chromium.evaluate("JSON.stringify(nookPage.page.state)"));
  expect(state.count === 1 && state.neighbours === 0, `?count=0&neighbours=-1: ${state.count} characters, ${state.neighbours} neighbours`);
  const panel = await chromium.evaluate("document.getElementById('panel').getBoundingClientRect().height");
  expect(panel < 140, `the panel of a small screen is folded: ${panel} pixels`);
  const key = (name) => chromium.evaluate(`document.getElementById("canvas").dispatchEvent(new KeyboardEvent("keydown", { key: "${name}", cancelable: true }))`);
  await key("ArrowRight");
  await key("+");
  await key("o");
  const moved = JSON.parse(await chromium.evaluate("JSON.stringify(nookPage.page.state)"));
  expect(moved.turn > state.turn && moved.distance < state.distance && !moved.on, "keys turn and move the camera, and switch AO");
  await chromium.evaluate("new Promise((done) => setTimeout(done, 600))");
  const address = await chromium.evaluate("location.search");
  expect(/on=false/.test(address) && /turn=33/.test(address) && /count=1(&|$)/.test(address), `the address stores the state: ${address}`);
  for (let i = 0; i < 2; ++i) {
    const { most, error } = await chromium.evaluate("nookPage.checks.loss(1.3)");
    expect(most === 0 && error === 0, `loss ${i + 1}: the picture differs by ${most} of 255, WebGL error ${error}`);
  }
  // Frames in a lost context are skipped, even before the event of the loss has arrived.
  const skipped = await chromium.evaluate(`(() => {
    const { page } = nookPage;
    page.webgl.getExtension("WEBGL_lose_context").loseContext();
    page.changed("azimuth");
    return page.draw(1) === false && !page.failed;
  })()`);
  expect(skipped, "in a lost context, drawing a frame and changing the light do nothing");
} catch (error) {
  expect(false, error.message);
} finally {
  await chromium.close();
  server.close();
}
process.exitCode = failures ? 1 : 0;
