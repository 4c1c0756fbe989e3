// Follows the examples for bundlers in docs/web.md, and docs/engines/three.md, each in an empty folder:
//   node guides_test.mjs PACKAGE.tgz HERO.glb HERO.nook FOLDER_OF_THE_COMMAND_NOOK
// Uses the code blocks of these pages. If the line before a block begins with "`NAME`:", the block is written to the file NAME.
// Blocks of sh are run. Other blocks are explanations and are skipped. The test needs npm's registry.
import { spawn, spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Chromium } from "./chromium.mjs";
import { serve } from "./serve.mjs";

const [tarball, glb, model, tools] = process.argv.slice(2);
const docs = join(dirname(fileURLToPath(import.meta.url)), "../../docs");
const scratch = mkdtempSync(join(tmpdir(), "nook-guides-"));
const [width, height] = [480, 320];
let failures = 0;
const expect = (right, text) => {
  console.log(`${right ? "  " : "! "}${text}`);
  failures += !right;
};

// Returns the code blocks of a page in order: { kind, name, text }.
function blocksOf(markdown) {
  return [...markdown.matchAll(/(?:^(.*)\n\n)?^```(\w*)\n([\s\S]*?)^```$/gm)].map(([, before, kind, text]) =>
    ({ kind, name: /^`([\w./-]+)`.*:$/.exec(before ?? "")?.[1], text }));
}

// Returns the lines that a reader has to write.
const linesOf = (blocks) => blocks.filter(({ kind }) => kind !== "sh").flatMap(({ text }) => text.split("\n"))
  .filter((line) => line.trim() && !line.trim().startsWith("//")).length;

const environment = { ...process.env, PATH: `${tools}:${process.env.PATH}`, NO_COLOR: "1", npm_config_audit: "false", npm_config_fund: "false",
  npm_config_update_notifier: "false", npm_config_yes: "true" };
function run(command, folder) {
  const { status, stdout, stderr } = spawnSync("bash", ["-e", "-c", command], { cwd: folder, env: environment, encoding: "utf8" });
  if (status !== 0) throw new Error(`${command}\n${stdout}${stderr}`);
  return stdout + stderr;
}

function emptyFolder(name) {
  const folder = join(scratch, name);
  mkdirSync(folder);
  copyFileSync(tarball, join(folder, basename(tarball)));
  return folder;
}

const chromium = new Chromium(width, height);
// Text that each bundle computes without WebGL: the sum of AO over a character's rest pose.
const answer = "globalThis.answer = await fetch('character.nook').then((file) => file.arrayBuffer()).then((bytes) => { " +
  "const scene = nook.createScene(), id = scene.addInstance(nook.loadCharacter(bytes)); scene.setGround(id, [0, 1, 0, 0]); " +
  "scene.update(); return scene.readAo(id).reduce((sum, ao) => sum + ao, 0).toFixed(6); });\n";

// Follows one bundler's section of docs/web.md. Returns the answer of its bundle.
async function bundle(section) {
  const name = section.split("\n", 1)[0].trim(), folder = emptyFolder(name.replace(/\W/g, "_")), blocks = blocksOf(section);
  run(`npm init -y && npm pkg set type=module && npm install ./${basename(tarball)}`, folder);
  let said = "";
  for (const { kind, name: file, text } of blocks)
    if (kind === "sh") said += run(text, folder);
    else writeFileSync(join(folder, file), file === "main.js" ? text + answer : text);
  const warnings = said.split("\n").filter((line) => /\bwarn(ing)?\b/i.test(line) && !/^npm warn /i.test(line));
  expect(warnings.length === 0, `${name}: ${warnings.length} warnings${warnings.map((line) => `\n      ${line}`).join("")}`);
  const dist = join(folder, "dist");
  copyFileSync(model, join(dist, "character.nook"));
  if (!readdirSync(dist).includes("index.html")) writeFileSync(join(dist, "index.html"), "<!doctype html><script type=module src=main.js></script>\n");
  const { server, url } = await serve(dist);
  try {
    await chromium.open(`${url}/`, width, height);
    await chromium.until("!!globalThis.answer", 60);
    return [name, await chromium.evaluate("globalThis.answer")];
  } finally {
    server.close();
  }
}

// Returns the mean brightness of the picture that the page shows, from 0 to 255.
async function brightness() {
  const png = (await chromium.screenshot()).toString("base64");
  return chromium.evaluate(`(async () => {
    const image = await createImageBitmap(await (await fetch("data:image/png;base64,${png}")).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += data[i] + data[i + 1] + data[i + 2];
    return sum / (3 * data.length / 4);
  })()`);
}
const frames = (count) => chromium.evaluate(`new Promise((done) => { let left = ${count}; const next = () => (left-- ? requestAnimationFrame(next) : done()); next(); })`);
const press = async () => {
  await chromium.evaluate("dispatchEvent(new KeyboardEvent('keydown', { key: 'o' }))");
  await frames(4);
};

// Checks the three.js page at an address: AO must darken it, and the key must switch AO off.
async function look(url, what) {
  await chromium.open(url, width, height);
  // The page is white before the first picture. Vite's development server loads the page again when it has found all modules.
  const end = Date.now() + 120000;
  for (let pictures = 0; pictures < 3; await new Promise((resolve) => setTimeout(resolve, 1000))) {
    pictures = await brightness().then((mean) => mean < 240, () => false) ? pictures + 1 : 0;
    if (Date.now() > end) throw new Error(`${what}: no picture in 120 s`);
  }
  await frames(4);
  const bright = { on: 0, off: 0 };
  // The character moves, so the test takes three pictures each with and without AO, in turn.
  for (let i = 0; i < 3; ++i) {
    bright.on += await brightness() / 3;
    await press();
    bright.off += await brightness() / 3;
    await press();
  }
  expect(bright.on < bright.off - 0.5 && bright.on > 60, `${what}: mean brightness ${bright.on.toFixed(2)} with AO, ${bright.off.toFixed(2)} without`);
}

// Starts a command that keeps running, and waits for the address that it prints.
function start(command, folder) {
  const server = spawn("bash", ["-e", "-c", command], { cwd: folder, env: environment, detached: true, stdio: ["ignore", "pipe", "pipe"] });
  return new Promise((resolve, reject) => {
    let said = "";
    const listen = (text) => {
      said += text;
      const url = /http:\/\/(?:localhost|127\.0\.0\.1):\d+\//.exec(said);
      if (url) resolve({ url: url[0], stop: () => process.kill(-server.pid) });
    };
    server.stdout.on("data", listen);
    server.stderr.on("data", listen);
    server.on("exit", () => reject(new Error(`${command} ended\n${said}`)));
  });
}

async function followThree() {
  const began = Date.now(), folder = emptyFolder("three"), blocks = blocksOf(readFileSync(join(docs, "engines/three.md"), "utf8")).filter(({ kind, name }) => kind === "sh" || name);
  copyFileSync(glb, join(folder, "hero.glb"));
  for (const { kind, name, text } of blocks) {
    if (kind !== "sh") writeFileSync(join(folder, name), text);
    else if (text.trim() !== "npx vite") run(text, folder);
    else {
      const { url, stop } = await start(text, folder);
      try {
        await look(url, "three.js, npx vite");
      } finally {
        stop();
      }
    }
  }
  const { server, url } = await serve(join(folder, "dist"));
  await look(`${url}/`, "three.js, npx vite build");
  server.close();
  const minutes = (Date.now() - began) / 60000, lines = linesOf(blocks);
  expect(minutes <= 20, `three.js from an empty folder: ${minutes.toFixed(1)} minutes (need <= 20)`);
  expect(lines <= 80, `three.js from an empty folder: ${lines} lines (need <= 80)`);
}

try {
  const sections = readFileSync(join(docs, "web.md"), "utf8").split("\n## ").find((part) => part.startsWith("Bundlers")).split("\n### ").slice(1);
  const answers = [];
  for (const section of sections) answers.push(await bundle(section));
  const node = emptyFolder("node");
  run(`npm init -y && npm pkg set type=module && npm install ./${basename(tarball)}`, node);
  writeFileSync(join(node, "main.js"), `import { readFileSync } from "node:fs";\nimport { load } from "nook-web";\nconst nook = await load();\n` +
    `globalThis.fetch = async () => new Response(readFileSync(${JSON.stringify(model)}));\n${answer}console.log(globalThis.answer);\n`);
  const expected = run("node main.js", node).trim();
  expect(sections.length === 4, `bundlers of docs/web.md: ${sections.length} (need 4)`);
  for (const [name, sum] of answers) expect(sum === expected, `${name}: sum of AO ${sum}, in node without a server ${expected}`);
  await followThree();
} catch (error) {
  expect(false, error.stack);
} finally {
  await chromium.close();
  rmSync(scratch, { recursive: true, force: true });
}
// The examples for bundlers have no icon.
const lines = chromium.console.filter((line) => !line.includes("/favicon.ico"));
expect(lines.length === 0, `errors and warnings on the console: ${lines.length}`);
for (const line of lines) console.log(`    ${line}`);
process.exitCode = failures ? 1 : 0;
