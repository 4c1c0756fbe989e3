// Checks the page in Chromium and prints its numbers: node test.mjs SITE [PICTURE.png]
import { writeFileSync } from "node:fs";
import { Chromium } from "../../web/chromium.mjs";
import { serve } from "../../web/serve.mjs";

const [site, file] = process.argv.slice(2);
const width = 480, height = 400;
let failures = 0;
function expect(right, text) {
  console.log(`${right ? "ok    " : "FAILED"} ${text}`);
  failures += !right;
}

const { server, url } = await serve(site);
const chromium = new Chromium(width, height);
try {
  await chromium.open(`${url}/?test`, width, height);
  await chromium.until("globalThis.checks !== undefined", 60);
  const run = async (check) => {
    const result = await chromium.evaluate(`checks.${check}()`);
    const error = await chromium.evaluate("checks.error()");
    expect(error === 0, `${check}: WebGL error ${error}`);
    return result;
  };

  const plain = await run("plain");
  expect(plain.colours > 1000, `the picture has ${plain.colours} colours, more than 1,000`);
  expect(plain.repeat === 0, `three.js alone draws the same picture twice: largest difference ${plain.repeat} of 255`);
  expect(plain.beside === 0, `the same picture while Nook runs: ${plain.beside} of 255`);
  expect(plain.shareZero === 0, `the same picture with Nook's materials and an AO share of 0: ${plain.shareZero} of 255`);

  const characters = await run("characters");
  // 2e-3 is half a step of 8 bits. With a smaller difference, no 8-bit picture changes by more than one step.
  expect(characters.difference <= 2e-3,
    `AO on ${characters.vertices} vertices of 3 characters against the CPU: ${characters.difference.toExponential(2)}, at most 2e-3`);
  expect(characters.least < 0.3 && characters.mean > 0.5, `smallest AO ${characters.least.toFixed(3)}, mean ${characters.mean.toFixed(3)}`);
  const worst = Math.max(...characters.poses.map(({ maxError }) => maxError));
  expect(characters.poses.every(({ fault }) => fault === "none"), `poses compared with the vertices that three.js skins: ${
    characters.poses[0].fault}, largest distance ${worst.toExponential(2)} of the radius`);

  const dark = await run("darkening");
  expect(dark.outside === 0, `no pixel grows brighter: ${dark.outside}`);
  // More than half of the light is ambient. So if half of the ambient light is gone, more than a tenth of all light is gone.
  expect(dark.low > 100 && dark.lowShare < 0.9, `${dark.low} pixels of AO below 0.5 keep ${dark.lowShare.toFixed(3)} of their light`);
  expect(dark.openShare > 0.97, `${dark.open} pixels of AO above 0.97 keep ${dark.openShare.toFixed(4)}`);

  const screen = await run("screen");
  // Colours reach 2. At 2, a half float has steps of 2^-10, and the AO in the comparison has 8 bits.
  expect(screen.most <= 2 ** -10 + 2 / 255, `the pass multiplies colour by its AO: ${screen.most.toExponential(2)}`);
  expect(screen.skyKept === 0, `the sky does not change: ${screen.skyKept}`);
  expect(screen.mean < 0.99 && screen.changed > 0.05, `mean AO ${screen.mean.toFixed(3)}, ${(100 * screen.changed).toFixed(0)} % of pixels change`);

  if (file) writeFileSync(file, Buffer.from(await chromium.evaluate("checks.pair()"), "base64"));

  const [mesh, depth] = await run("faults");
  expect(/24 of 24 vertices are not in the model/.test(mesh), `another mesh: ${mesh}`);
  expect(/has no depthTexture/.test(depth), `no depth: ${depth}`);
  const resize = await run("resize");
  expect(resize.most === 0, `the same picture after other sizes: ${resize.most} of 255`);
  const loss = await run("loss");
  expect(loss.most === 0, `the same picture after a lost context: ${loss.most} of 255`);
  const life = await run("life");
  expect(life.restored === 0, `the same picture after frames in a lost context: ${life.restored} of 255`);
  expect(life.isOwn && life.removed > 0, `a removed character has its own geometry and material: ${life.removed} of 255`);
  expect(life.added === 0, `the same picture after it is added again: ${life.added} of 255`);
  expect(life.best > 0 && life.same === 0, `options reach the pass: ${life.best} of 255 with ${life.taps} taps, ${life.same} again without them`);
  const end = await run("end");
  expect(end.objects === 0 && end.characters === 0, `WebGL objects after dispose(): ${end.objects}`);

  await chromium.open(`${url}/`, width, height);
  await chromium.until("document.querySelector('canvas') !== null", 60);
  await chromium.evaluate("new Promise((done) => setTimeout(done, 3000))");
  expect(chromium.console.length === 0, `errors and warnings on the console: ${chromium.console.length}`);
  chromium.console.forEach((line) => console.log(`       ${line}`));
} finally {
  await chromium.close();
  server.close();
}
process.exit(failures ? 1 : 0);
