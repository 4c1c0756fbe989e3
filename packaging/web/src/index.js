// Nook for WebGL 2: see README.md, and index.d.ts for the types.
import makeModule from "./nook_module.mjs";
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

async function instantiate(wasm, imports) {
  const source = await (wasm ?? new URL("./nook.wasm", import.meta.url));
  if (source instanceof WebAssembly.Module) return { module: source, instance: await WebAssembly.instantiate(source, imports) };
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.instantiate(source, imports);
  const response = await (typeof Response !== "undefined" && source instanceof Response ? source : fetch(source));
  if (!response.ok) throw new Error(`nook-web: ${response.url} cannot be fetched (status ${response.status}); give load({ wasm })`);
  // Servers that do not know the type application/wasm are common.
  if ((response.headers.get("Content-Type") ?? "").startsWith("application/wasm"))
    return WebAssembly.instantiateStreaming(response, imports);
  return WebAssembly.instantiate(await response.arrayBuffer(), imports);
}

// Loads the module of WebAssembly and makes a context in it. wasm: where nook.wasm is, if it does not lie beside this file, or
// its bytes; log(severity, text) takes the lines of the library's log;
// isa chooses the instruction set of all objects, unitsPerMetre the unit of lengths.
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
