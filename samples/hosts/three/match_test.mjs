// Checks how NookThree matches the vertices of characters that three.js's GLTFLoader has loaded:
//   node match_test.mjs SITE FOLDER NOOK
// FOLDER contains the characters as .glb files. NOOK is the command `nook`. It bakes them in few steps, because matching does
// not need accurate AO.
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { Chromium } from "../../web/chromium.mjs";
import { serve } from "../../web/serve.mjs";

const [site, characters, nook] = process.argv.slice(2);
const width = 480, height = 400;
const quick = ["--poses", "auto", "--auto-poses", "8", "--rays", "16", "--steps", "20", "--spheres", "20", "--key-points", "60"];
let failures = 0;
function expect(right, text) {
  console.log(`${right ? "ok    " : "FAILED"} ${text}`);
  failures += !right;
}

mkdirSync(join(site, "match"), { recursive: true });
const names = readdirSync(characters).filter((file) => file.endsWith(".glb")).map((file) => file.slice(0, -4)).sort();
for (const name of names) {
  const glb = join(site, "match", `${name}.glb`), model = join(site, "match", `${name}.nook`);
  if (!existsSync(glb)) copyFileSync(join(characters, `${name}.glb`), glb);
  if (existsSync(model)) continue;
  const { status, stderr } = spawnSync(nook, ["bake", "character", glb, ...quick, "--quiet", "-o", model], { encoding: "utf8" });
  if (status !== 0) throw new Error(`the bake of ${name} failed: ${stderr}`);
}

const { server, url } = await serve(site);
const chromium = new Chromium(width, height);
try {
  await chromium.open(`${url}/?test`, width, height);
  await chromium.until("globalThis.checks !== undefined", 120);
  for (const name of names)
    for (const isShuffled of [false, true]) {
      const { vertices, wrong, ambiguous, most } = await chromium.evaluate(`import("./match.js").then(({ measure }) => measure("${name}", ${isShuffled}))`);
      expect(isShuffled ? wrong <= ambiguous : wrong + ambiguous === 0, `${name}, ${isShuffled ? "shuffled" : "the loader's order"}: of ${vertices} vertices, ${
        wrong} are matched wrongly and ${ambiguous} are ambiguous; AO differs by at most ${most.toFixed(3)}`);
    }
} catch (error) {
  expect(false, error.stack);
} finally {
  await chromium.close();
  server.close();
}
process.exit(failures ? 1 : 0);
