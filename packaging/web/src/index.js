// Nook for WebGL 2: see README.md, and index.d.ts for the types.
import makeModule from "./nook.mjs";
import { Context } from "./context.js";
import { Library } from "./library.js";

export { NookError } from "./error.js";
export { Context } from "./context.js";
export { CharacterModel } from "./character.js";
export { Scene } from "./scene.js";
export { Gl, Upload } from "./gl.js";
export { Nnao } from "./nnao.js";
export { Probe, ProbeFit } from "./probe.js";
export { Material } from "./material.js";

// Returns the bytes of a file, because Node's fetch does not support file: URLs. The module's name is in a variable, so that bundlers
// for browsers do not try to include it.
async function readFile(url) {
  const name = "node:fs/promises";
  const files = globalThis.process?.getBuiltinModule?.(name) ?? await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
  return files.readFile(url);
}

const isBytes = (value) => ArrayBuffer.isView(value) || Object.prototype.toString.call(value) === "[object ArrayBuffer]";

// Returns the module and an instance of it.
async function compile(wasm, imports) {
  const source = await (wasm ?? new URL("./nook.wasm", import.meta.url));
  if (source instanceof WebAssembly.Module) return { module: source, instance: await WebAssembly.instantiate(source, imports) };
  if (isBytes(source)) return WebAssembly.instantiate(source, imports);
  const isResponse = typeof Response !== "undefined" && source instanceof Response;
  if (!isResponse && typeof source !== "string" && !(source instanceof URL))
    throw new Error("wasm needs an address, a Response, bytes or a WebAssembly.Module");
  if (!isResponse && globalThis.process?.versions?.node) {
    const url = new URL(source, `file://${globalThis.process.cwd()}/`);
    if (url.protocol === "file:") return WebAssembly.instantiate(await readFile(url), imports);
  }
  const response = isResponse ? source : await fetch(source);
  if (!response.ok) throw new Error(`the server answered with status ${response.status}`);
  // Many servers do not send the type application/wasm.
  if ((response.headers.get("Content-Type") ?? "").startsWith("application/wasm"))
    return WebAssembly.instantiateStreaming(response, imports);
  return WebAssembly.instantiate(await response.arrayBuffer(), imports);
}
async function instantiate(wasm, imports) {
  try {
    return await compile(wasm, imports);
  } catch (error) {
    const isPlace = wasm === undefined || typeof wasm === "string" || wasm instanceof URL;
    const from = isPlace ? ` from ${wasm ?? new URL("./nook.wasm", import.meta.url)}` : "";
    const cure = /unsafe-eval|Content Security Policy/i.test(error.message)
      ? "the page's content security policy must allow 'wasm-unsafe-eval' in script-src"
      : "put nook.wasm of the package beside its index.js, or pass its address to load({ wasm })";
    throw new Error(`nook-web: the WebAssembly module cannot be loaded${from} (${error.message}); ${cure}`, { cause: error });
  }
}

// Loads the WebAssembly module and creates a context in it. `wasm` is the location of nook.wasm (default: beside this file), or its
// bytes. log(severity, text) is called with each line of the library's log. `isa` sets the instruction set of all objects, and
// `unitsPerMetre` the unit of lengths.
export async function load({ wasm, log, isa, unitsPerMetre } = {}) {
  const module = await new Promise((resolve, reject) => {
    makeModule({
      instantiateWasm(imports, receive) {
        instantiate(wasm, imports).then(({ instance, module: compiled }) => receive(instance, compiled), reject);
        return {};
      },
    }).then(resolve, reject);
  });
  return Context.make(new Library(module), log, isa, unitsPerMetre);
}
