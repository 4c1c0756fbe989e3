import { checkBytes, checkNumbers, checkObject, refuse } from "./arguments.js";
import { CharacterModel } from "./character.js";
import { Gl } from "./gl.js";
import { Owned } from "./library.js";
import { Material } from "./material.js";
import { Probe, ProbeFit } from "./probe.js";
import { Scene } from "./scene.js";

// One instance of the library. It makes all other objects.
export class Context extends Owned {
  // isa: a word of nook_isa.
  static make(library, log, isa = "auto", unitsPerMetre = 1) {
    const { module } = library;
    const severities = ["info", "warning", "error"];
    if (log !== undefined && log !== null && typeof log !== "function") refuse("nook_context_create", "log needs a function");
    module.nookLog = log ? (severity, text) => log(severities[severity], text) : () => {};
    return new Context(library, library.call("nook_context_create", () => {
      const description = library.prepared("nook_context_desc", { log: log ? module._nook_web_log() : 0, isa, unitsPerMetre });
      return library.made((out) => module._nook_context_create(description(), out));
    }));
  }
  constructor(library, handle) {
    super(library, handle, "nook_context_destroy");
  }

  // For example "1.0.0-rc1".
  get version() {
    const { module } = this.library;
    return module.UTF8ToString(module._nook_version_text());
  }
  // The memory of the module in bytes; it grows and never shrinks.
  get memoryBytes() {
    return this.library.module.HEAPU8.length;
  }

  #load(name, bytes, call) {
    const { library } = this;
    return library.call(name, () => {
      checkBytes(name, "bytes", bytes);
      return library.made((out) => {
        const copy = library.bytes(bytes);
        return call(this.handle, copy.address, copy.size, out);
      });
    });
  }
  // These functions take the bytes of .nook files.
  loadCharacter(bytes) {
    return new CharacterModel(this.library, this.#load("nook_model_load", bytes, this.library.module._nook_model_load));
  }
  loadProbe(bytes) {
    return new Probe(this.library, this.#load("nook_probe_load", bytes, this.library.module._nook_probe_load));
  }
  loadMaterial(bytes) {
    const load = (context, address, size, out) => this.library.module._nook_material_load(context, address, size, 0, out);
    return new Material(this.library, this.#load("nook_material_load", bytes, load));
  }

  // `options` has the members of nook_scene_desc in camelCase.
  createScene(options = {}) {
    const { library } = this;
    return new Scene(library, library.call("nook_scene_create", () => {
      checkObject(library.name, "options", options);
      const description = library.prepared("nook_scene_desc", options);
      return library.made((out) => library.module._nook_scene_create(this.handle, description(), out));
    }));
  }
  // `options` has the members of nook_probe_fit_desc in camelCase. The default of lobeCount is the number of axes or
  // sharpnesses.
  createProbeFit(options = {}) {
    const { library } = this;
    return new ProbeFit(library, library.call("nook_probe_fit_create", () => {
      checkObject(library.name, "options", options);
      const { axes, sharpnesses, ...others } = options;
      checkNumbers(library.name, "axes", axes, { groupsOf: 3, optional: true });
      checkNumbers(library.name, "sharpnesses", sharpnesses, { optional: true });
      const lobeCount = options.lobeCount ?? (axes ? axes.length / 3 : sharpnesses?.length);
      if (axes) checkNumbers(library.name, "axes", axes, { count: 3 * lobeCount, why: `for ${lobeCount} lobes` });
      if (sharpnesses) checkNumbers(library.name, "sharpnesses", sharpnesses, { count: lobeCount, why: `for ${lobeCount} lobes` });
      const description = library.prepared("nook_probe_fit_desc",
        { ...others, lobeCount, axes: () => library.floats(axes), sharpnesses: () => library.floats(sharpnesses) });
      return library.made((out) => library.module._nook_probe_fit_create(this.handle, description(), out));
    }));
  }
  // Adopts a WebGL 2 context of the host. options: { stateMode: "defaults" (default), "preserve" or "host" }.
  createGl(webgl, options = {}) {
    return Gl.make(this.library, this.handle, webgl, options);
  }
}
