// The page of `nook report` in Chromium: node report_page.mjs TOOL WRITE_INPUTS FOLDER [PAGE.html]
// With PAGE the page is there already. Pictures of both colour schemes and of the turned body go to FOLDER.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Chromium } from "../../../samples/web/chromium.mjs";

const [tool, writeInputs, folder, given] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const page = given ?? join(folder, "page.html");
if (!given) {
  const shape = join(folder, "hero.glb"), model = join(folder, "hero.nook");
  execFileSync(writeInputs, [shape]);
  execFileSync(tool, ["bake", "character", shape, "-o", model, "--preset", "draft", "--poses", "auto", "--auto-poses", "20", "--rays", "4",
    "--steps", "20", "--spheres", "6", "--key-points", "20", "--quiet"]);
  execFileSync(tool, ["report", model, shape, "-o", page, "--rays", "16", "--quiet"]);
}
let failed = false;
const check = (name, value, holds) => {
  failed ||= !holds;
  console.log(`${holds ? "  " : "! "}${name}: ${value}`);
};

const chromium = new Chromium(1100, 900);
try {
  await chromium.open(pathToFileURL(resolve(page)).href, 1100, 900);
  await chromium.until("document.readyState === 'complete'", 60);
  const scheme = (value) => chromium.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
  const whole = async (name) => {
    const { data } = await chromium.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: true });
    writeFileSync(join(folder, `${name}.png`), Buffer.from(data, "base64"));
  };
  const colours = [];
  for (const value of ["light", "dark"]) {
    await scheme(value);
    await whole(value);
    colours.push(await chromium.evaluate("getComputedStyle(document.body).backgroundColor"));
  }
  check("background light, dark", colours.join(", "), colours[0] !== colours[1]);
  check("pictures that did not load", await chromium.evaluate("[...document.images].filter((i) => !i.naturalWidth).length"),
    await chromium.evaluate("[...document.images].every((i) => i.naturalWidth > 0 && i.alt.length > 10)"));
  check("resources that the page loaded", await chromium.evaluate("performance.getEntriesByType('resource').filter((r) => !r.name.startsWith('data:')).length"),
    await chromium.evaluate("performance.getEntriesByType('resource').every((r) => r.name.startsWith('data:'))"));
  await chromium.size(390, 800);
  const phone = await chromium.evaluate("document.documentElement.scrollWidth");
  check("width of the page on a phone, pixels", phone, phone <= 390);
  await whole("phone");
  await chromium.size(1100, 900);
  if (await chromium.evaluate("!!document.getElementById('turn-canvas')")) {
    // The share of the canvas that is no background, and how much of it changes when the body turns.
    const pixels = `(() => { const c = document.getElementById('turn-canvas'), t = document.createElement('canvas');
      t.width = c.width; t.height = c.height; const x = t.getContext('2d'); x.drawImage(c, 0, 0);
      return [...x.getImageData(0, 0, t.width, t.height).data].filter((v, i) => i % 4 === 0); })()`;
    const press = (key) => `document.getElementById('turn-canvas').dispatchEvent(new KeyboardEvent('keydown', { key: '${key}', cancelable: true }))`;
    const before = await chromium.evaluate(pixels);
    const body = before.filter((v) => v !== 82).length / before.length;
    check("share of the view that is body", body, body > 0.02 && body < 0.95);
    await chromium.evaluate(Array(8).fill(press("ArrowRight")).join(";"));
    const after = await chromium.evaluate(pixels);
    const changed = after.filter((v, i) => v !== before[i]).length / after.length;
    check("share that changes when it turns", changed, changed > 0.01);
    await chromium.evaluate("document.querySelector('[data-show=error]').click(); document.getElementById('turn').scrollIntoView()");
    writeFileSync(join(folder, "turn.png"), await chromium.screenshot());
    check("poses to choose", await chromium.evaluate("document.getElementById('turn-pose').options.length"),
      await chromium.evaluate("document.getElementById('turn-pose').options.length > 1"));
  }
} catch (error) {
  check("the test itself", error.message, false);
} finally {
  await chromium.close();
}
check("errors and warnings of the console", chromium.console.length, chromium.console.length === 0);
for (const line of chromium.console) console.log(`    ${line}`);
process.exitCode = failed ? 1 : 0;
