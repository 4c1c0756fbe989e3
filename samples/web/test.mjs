// Tests the page in Chromium: node test.mjs SITE RESULTS_FOLDER SECONDS_OF_FRAMES
import { readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { Chromium } from "./chromium.mjs";
import { serve } from "./serve.mjs";

const [site, results, seconds] = process.argv.slice(2);
const [width, height] = [1024, 576];
const rows = [];
const check = (name, value, holds, need) => {
  rows.push({ name, value, holds, need });
  console.log(`${holds ? "  " : "! "}${name.padEnd(58)} ${typeof value === "number" ? Number(value.toPrecision(4)) : value}${need ? `   (need ${need})` : ""}`);
};

// Returns how many bytes a visitor downloads without the models, from a server with compression.
function downloadBytes(folder) {
  let sum = 0;
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) sum += name === "data" ? 0 : downloadBytes(path);
    else if (/\.(html|css|js|mjs|wasm)$/.test(name)) sum += gzipSync(readFileSync(path), { level: 9 }).length;
  }
  return sum;
}
const megabytes = downloadBytes(site) / 1e6;
check("download without models, gzip -9, MB", megabytes, megabytes <= 0.8, "<= 0.8");

const { server, url } = await serve(site);
const chromium = new Chromium(width, height);
const call = (name, ...values) => chromium.evaluate(`nookPage.checks.${name}(${values.map((value) => JSON.stringify(value)).join(", ")})`);
try {
  await chromium.open(`${url}/?check`, width, height);
  await chromium.until("!!window.nookPage || document.getElementById('message').classList.contains('error')", 120);
  check("GL_VERSION", await chromium.evaluate("nookPage.page.renderer.ao.info.version"), true);

  const characters = await call("characters");
  // 2e-3 is the bound between any two ways to evaluate a scene. Different instruction sets of the CPU differ by at most 1.2e-4.
  check("AO of WebGL against native, largest difference", characters.gpuNative, characters.gpuNative <= 2e-3, "<= 2e-3");
  check("AO of WebGL against the CPU in WebAssembly", characters.gpuCpu, characters.gpuCpu <= 2e-3, "<= 2e-3");
  check("AO of the CPU in WebAssembly against native", characters.cpuNative, characters.cpuNative <= 1.2e-4, "<= 1.2e-4");
  check("directional occlusion of WebGL against the CPU", characters.directional, characters.directional <= 4e-3, "<= 4e-3");
  check("mean AO of this scene", characters.mean, characters.mean > 0.2 && characters.mean < 0.8, "0.2 to 0.8");

  const screen = await call("screenFiles");
  check("screen pass: share of pixels within 1/255 of the reference", screen.share, screen.share >= 0.999, ">= 0.999");
  check("screen pass: mean AO", screen.mean, screen.mean > 0.3 && screen.mean < 0.99, "0.3 to 0.99");
  const picture = await call("picture");
  // Two rasterisers cover different pixels at edges, and round depth differently. So one pixel in a hundred may differ.
  check("picture against the native one: share within 2/255", picture.share, picture.share >= 0.99, ">= 0.99");
  check("picture against the native one: mean difference, of 255", picture.mean, picture.mean <= 0.5, "<= 0.5");
  check("picture: shades of red", picture.colours, picture.colours > 50, "> 50");
  check("picture: WebGL error", picture.error, picture.error === 0, "0");
  const material = await call("material");
  check("material: visibility of a sample on the CPU", material.visibility, material.radiance.every(Number.isFinite), "finite radiance");

  const pictures = {
    lit: { count: 12 },
    open: { characterAo: false, screenAo: false, light: "probe" },
    ao: { characterAo: true, screenAo: true, light: "lobes", view: "ao" },
    screen: { view: "screen" },
    error: { view: "error" },
    material: { view: "lit", material: true },
    crowd: { material: false, count: 50, distance: 10.5, tilt: 20 },
  };
  for (const [name, state] of Object.entries(pictures)) {
    await call("set", state);
    const error = await call("draw", 1.3);
    check(`picture ${name}: WebGL error`, error, error === 0, "0");
    writeFileSync(join(results, `${name}.png`), await chromium.screenshot());
    if (name !== "error") continue;
    const mse = await call("error");
    // For draft bakes of the mannequin, the error on their own clips is 2e-3 to 6e-3.
    check("error picture: mean squared error against ray tracing", mse, mse < 8e-3, "< 8e-3");
  }
  // SwiftShader draws on the CPU. The frames are small so that many of them are drawn.
  await chromium.size(width / 4, height / 4);
  const crowd = await call("frames", Math.min(5, seconds));
  check("50 characters: frames per second, SwiftShader", crowd.count / crowd.seconds, crowd.errors === 0, "no error");

  await call("set", { count: 12, material: true, distance: 7.8, tilt: 15 });
  const frames = await call("frames", Number(seconds));
  check(`frames in ${frames.seconds.toFixed(0)} s`, frames.count, frames.errors === 0, "no error");
  check("growth of the module's memory, bytes", frames.end.memory - frames.start.memory, frames.end.memory === frames.start.memory, "0");
  check("growth of the library's WebGL objects", frames.end.objects - frames.start.objects, frames.end.objects === frames.start.objects, "0");
  check("the module's memory, MB", frames.end.memory / 1e6, true);

  const before = await chromium.evaluate("nookPage.page.renderer.ao.objectCount");
  const loss = await call("loss", 1.3);
  check("lost context: largest difference of the picture, of 255", loss.most, loss.most === 0, "0");
  check("lost context: WebGL error", loss.error, loss.error === 0, "0");
  check("lost context: objects after minus before", loss.objects - before, loss.objects === before, "0");
} catch (error) {
  check(`the test itself: ${error.message}`, "failed", false);
} finally {
  await chromium.close();
  server.close();
}
check("errors and warnings on the console", chromium.console.length, chromium.console.length === 0, "0");
for (const line of chromium.console) console.log(`    ${line}`);
writeFileSync(join(results, "results.json"), `${JSON.stringify({ rows }, null, 1)}\n`);
process.exitCode = rows.every(({ holds }) => holds) ? 0 : 1;
