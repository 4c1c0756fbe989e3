// The address of the sample page: node address_test.mjs PAGE FOLDER
import assert from "node:assert/strict";
import { copySources } from "./stand_in.mjs";

const [page, folder] = process.argv.slice(2);
const { readAddress, readTime, writeAddress } = await copySources(page, folder)("address.js");
const initial = { view: "lit", count: 12, neighbours: 4, radius: 0.45, ground: true, turn: 28 };
const limits = {
  view: { choices: [["lit", ""], ["ao", ""]] }, count: { min: 1, max: 100, step: 1 }, neighbours: { min: 0, max: 8, step: 1 },
  radius: { min: 0.1, max: 1.5, step: 0.05 }, turn: { min: 0, max: 360, wraps: true },
};
const read = (search) => {
  const state = { ...initial };
  readAddress(search, state, limits);
  return state;
};
const changes = {
  "?count=0": { count: 1 }, "?count=-5": { count: 1 }, "?count=1e9": { count: 100 }, "?count=7.4": { count: 7 }, "?count=5&count=abc": { count: 5 },
  "?neighbours=-1": { neighbours: 0 }, "?neighbours=4294967295": { neighbours: 8 }, "?radius=0.47": { radius: 0.45 }, "?radius=9": { radius: 1.5 },
  "?view=ao": { view: "ao" }, "?ground=false": { ground: false }, "?ground=0": { ground: false }, "?ground=TRUE": {}, "?turn=-30": { turn: 330 },
};
for (const [search, change] of Object.entries(changes)) assert.deepEqual(read(search), { ...initial, ...change }, search);
for (const search of ["", "?", "?count=abc", "?count=", "?count", "?count=%20", "?count=NaN", "?count=Infinity", "?count=12px", "?count=null", "?view=none",
  "?view=", "?ground=maybe", "?ground=", "?radius=1,5", "?other=1", "?__proto__=1", "?constructor=1", "?toString=3", "?hasOwnProperty=1", "?count[]=3"])
  assert.deepEqual(read(search), initial, search);

// What is written is read again, beside what the address has else.
const state = { ...initial, count: 30, view: "ao", ground: false, radius: 0.6, turn: 123.456 };
const written = writeAddress("?time=1.5&count=3", state, initial);
assert.equal(new URLSearchParams(written).get("time"), "1.5");
assert.deepEqual(read(written), state);
assert.equal(writeAddress("?count=3", initial, initial), "");
assert.deepEqual(["", "?time=", "?time=abc", "?time=Infinity", "?time=0", "?time=2.5"].map(readTime), [null, null, null, null, 0, 2.5]);
console.log("address: right");
