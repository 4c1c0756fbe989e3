// The page of `nook report --all` in Chromium: node overview_page.mjs WRITE_OVERVIEW FOLDER [PAGE.html]
// With PAGE the page is there already. Pictures of both colour schemes and of a phone go to FOLDER.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Chromium } from "../../../../samples/web/chromium.mjs";

const [writeOverview, folder, given] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const page = given ?? join(folder, "all.html");
if (!given) execFileSync(writeOverview, ["5000", page]);
let failed = false;
const check = (name, value, holds) => {
  failed ||= !holds;
  console.log(`${holds ? "  " : "! "}${name}: ${value}`);
};

const chromium = new Chromium(1200, 900);
const save = async (name) => writeFileSync(join(folder, `${name}.png`), await chromium.screenshot());
const count = () => chromium.evaluate("document.querySelectorAll('#list tbody tr').length");
const shown = () => chromium.evaluate("document.getElementById('shown').textContent");
try {
  await chromium.open(pathToFileURL(resolve(page)).href, 1200, 900);
  await chromium.until("document.readyState === 'complete'", 60);
  const first = await chromium.evaluate("performance.getEntriesByName('rows')[0].startTime");
  // A second, in which a reader does not lose the thread.
  check("milliseconds to the first rows", Math.round(first), first < 1000);
  check("rows that are drawn at first", await count(), (await count()) >= 60 && (await count()) <= 300);
  const state = await chromium.evaluate("document.querySelector('#list .state').textContent");
  check("first state", state, given || state === "failed");
  const colours = [];
  for (const value of ["dark", "light"]) {
    await chromium.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
    colours.push(await chromium.evaluate("getComputedStyle(document.body).backgroundColor"));
    await save(value);
  }
  check("background dark, light", colours.join(", "), colours[0] !== colours[1]);
  await chromium.size(390, 800);
  const phone = await chromium.evaluate("document.documentElement.scrollWidth");
  check("width of the page on a phone, pixels", phone, phone <= 390);
  await save("phone_top");
  await chromium.evaluate("document.getElementById('shown').scrollIntoView()");
  await save("phone");
  await chromium.size(1200, 900);
  if (!given) {
    const set = (id, value, event) => chromium.evaluate(`(() => { const e = document.getElementById('${id}'); e.value = ${JSON.stringify(value)};
      const t = performance.now(); e.dispatchEvent(new Event('${event}')); return performance.now() - t; })()`);
    const took = await set("search", "ONERROR", "input");
    check("milliseconds of a search", Math.round(took), took < 300);
    check("a search", await shown(), (await shown()) === "10 of 5001 rows");
    check("markup in a name is text", await chromium.evaluate("document.querySelectorAll('#list img').length"),
      await chromium.evaluate("!document.querySelector('#list img') && document.querySelector('#list .asset').textContent.includes('</script><img')"));
    await chromium.evaluate("document.getElementById('clear').click()");
    await chromium.evaluate("[...document.querySelectorAll('#states button')].find((b) => b.textContent.startsWith('failed')).click()");
    check("a state", await shown(), (await shown()) === "20 of 5001 rows");
    await chromium.evaluate("document.getElementById('clear').click()");
    await set("kind", "kmaterial", "change");
    check("a kind", await shown(), (await shown()) === "1000 of 5001 rows");
    await chromium.evaluate("document.getElementById('clear').click()");
    await set("order", "bytes", "change");
    const sizes = await chromium.evaluate("[...document.querySelectorAll('#list td.size')].slice(0, 5).map((c) => parseFloat(c.textContent))");
    check("the largest first", sizes.join(), sizes.every((size, i) => i === 0 || size <= sizes[i - 1]) && sizes[0] > 200);
    await set("change", "5", "change");
    check("what is gone", await shown(), (await shown()) === "1 of 5001 rows");
    await chromium.evaluate("document.getElementById('clear').click()");
    for (let i = 0; i < 5; ++i) {
      const before = await count();
      await chromium.evaluate("document.getElementById('more').scrollIntoView({ block: 'end' })");
      await chromium.until(`document.querySelectorAll('#list tbody tr').length > ${before}`, 20);
    }
    check("rows after scrolling", await count(), (await count()) >= 360);
    check("a link to a page", await chromium.evaluate("document.querySelector('#list a').getAttribute('href')"),
      await chromium.evaluate("document.querySelector('#list a').getAttribute('href').startsWith('out/characters/act%20')"));
  }
} catch (error) {
  check("the test itself", error.message, false);
} finally {
  await chromium.close();
}
check("errors and warnings of the console", chromium.console.length, chromium.console.length === 0);
for (const line of chromium.console) console.log(`    ${line}`);
process.exitCode = failed ? 1 : 0;
