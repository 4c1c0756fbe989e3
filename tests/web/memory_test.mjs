// Arguments of nook-web when the module has no memory left: node memory_test.mjs SOURCES FOLDER
// A module of JavaScript stands for WebAssembly: its malloc fails on demand, and its low addresses are watched.
import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [sources, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "package.json"), "{\"type\": \"module\"}\n");
for (const name of readdirSync(sources)) if (name.endsWith(".js")) copyFileSync(join(sources, name), join(folder, name));
const { Library } = await import(pathToFileURL(join(folder, "library.js")));
const { NookError } = await import(pathToFileURL(join(folder, "error.js")));

const low = 1024;
function makeModule(memory) {
  const buffer = new ArrayBuffer(memory);
  const module = {
    HEAPU8: new Uint8Array(buffer), HEAPU32: new Uint32Array(buffer), HEAP32: new Int32Array(buffer), HEAPF32: new Float32Array(buffer),
    left: Infinity, next: low, freed: [],
    _malloc(size) {
      if (size > module.left || module.next + size > memory) return 0;
      module.left -= size;
      module.next += size;
      return module.next - size;
    },
    _free(address) { module.freed.push(address); },
    _nook_version: () => 1, _nook_web_constants: () => 0, _nook_web_fields: () => 0, _nook_desc_init: () => 0,
    _nook_model_load: () => 0, UTF8ToString: () => "",
  };
  return module;
}
function withStructs(library) {
  const constants = { numbers: new Map([["scene", 0], ["probe-fit", 0]]), wordOf: new Map() };
  library.layouts.constants.set("bits NOOK_DESC_CONTEXT", constants);
  library.layouts.structs.set("nook_scene_desc", { name: "nook_scene_desc", size: 64, fields: new Map() });
  return library;
}
const untouched = (module) => module.HEAPU8.subarray(0, low).every((byte) => byte === 0);

// Everything that takes memory for a call.
const takers = {
  floats: (library) => library.floats(new Float32Array(100).fill(1)),
  integers: (library) => library.integers([1, 2, 3]),
  bytes: (library) => library.bytes(new Uint8Array(100).fill(7)),
  texts: (library) => library.texts(["a bone", "another"]),
  descriptor: (library) => library.descriptor("nook_scene_desc"),
  struct: (library) => library.struct("nook_scene_desc"),
  made: (library) => library.made(() => 0),
  info: (library) => library.info("nook_test", "nook_scene_desc", () => 0),
  readFloats: (library) => library.readFloats("nook_test", 100, null, () => 0),
  destroy: (library) => library.destroy("nook_model_load", 4),
};
for (const [name, take] of Object.entries(takers)) {
  const module = makeModule(1 << 20);
  module.left = 0;  // not even the first block
  const library = withStructs(new Library(module));
  const expected = name === "destroy" ? "nook_model_load" : "nook_test";
  assert.throws(() => library.call(expected, () => take(library)), (error) => error instanceof NookError &&
    error.code === "NOOK_ERROR_OUT_OF_MEMORY" && new RegExp(`^${expected}: no memory for \\d+ bytes`).test(error.message), name);
  assert.ok(untouched(module), `${name} wrote at low addresses`);
  // The next call works when there is memory again.
  module.left = Infinity;
  library.call(expected, () => take(library));
  assert.ok(untouched(module), `${name} wrote at low addresses after a failure`);
}

// A model that does not fit, and the size in the message. Afterwards nothing asks for that much again.
{
  const module = makeModule(1 << 20);
  const library = withStructs(new Library(module));
  module.left = 1 << 18;
  assert.throws(() => library.call("nook_model_load", () => library.bytes(new Uint8Array(300000))),
    /nook_model_load: no memory for 300000 bytes/);
  for (let i = 0; i < 100; ++i) library.call("nook_test", () => library.floats([i]));
  assert.ok(untouched(module));
  assert.equal(module.next, low + (1 << 16));
}

// The block cannot grow after a large call: the old size is taken again, or none, and calls go on.
{
  const module = makeModule(1 << 20);
  const library = withStructs(new Library(module));
  module.left = 200000;
  library.call("nook_test", () => library.bytes(new Uint8Array(200000 - 16)));
  assert.equal(library.room.capacity, 0);
  module.left = 0;
  assert.throws(() => library.call("nook_test", () => library.floats([1])), /nook_test: no memory for 4 bytes/);
  module.left = Infinity;
  library.call("nook_test", () => library.floats([1]));
  assert.ok(untouched(module));
}

// Sizes that 32 bits cannot hold would be taken modulo, and sizes that are no numbers would be 16 bytes.
{
  const module = makeModule(1 << 20);
  const library = withStructs(new Library(module));
  for (const bytes of [2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 32 + 64, 2 ** 40])
    assert.throws(() => library.call("nook_test", () => library.room.take(bytes)), (error) => error.code === "NOOK_ERROR_OUT_OF_MEMORY", `${bytes}`);
  for (const bytes of [NaN, undefined, -4, 1.5, Infinity])
    assert.throws(() => library.call("nook_test", () => library.room.take(bytes)), (error) => error.code === "NOOK_ERROR_INVALID_ARGUMENT", `${bytes}`);
  assert.throws(() => library.call("nook_test", () => library.floats({ length: undefined })), /nook_test: an argument has no size/);
}
console.log("memory: right");
