import { checkBytes, checkIndex, checkNumbers, checkObject, checkWebGL } from "./arguments.js";
import { NookError } from "./error.js";
import { Material } from "./material.js";
import { Nnao } from "./nnao.js";
import { OnSurface, makeOnSurface } from "./on_surface.js";
import { Probe } from "./probe.js";
import { Scene } from "./scene.js";
import { Surface } from "./surface.js";

// A WebGL 2 context into which the library draws; see nook_gl.h.
export class Gl extends OnSurface {
  static make(library, context, webgl, options = {}) {
    if (!webgl || typeof webgl.createTransformFeedback !== "function")
      throw new NookError("Context.createGl: webgl is not a WebGL2RenderingContext; call canvas.getContext(\"webgl2\")",
        "NOOK_ERROR_UNSUPPORTED");
    if (webgl.isContextLost?.())
      throw new NookError("Context.createGl: the WebGL context is lost; call it after \"webglcontextrestored\"", "NOOK_ERROR_GL");
    const surface = Surface.of(library.module.GL, webgl);
    return makeOnSurface(Gl, library, surface, "nook_gl_create", () => {
      checkObject(library.name, "options", options);
      const description = library.prepared("nook_gl_desc", { stateMode: "defaults", ...options, getProc: library.module._nook_web_get_proc() });
      return (out) => library.module._nook_gl_create(context, description(), out);
    });
  }
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_destroy", surface);
  }

  #current(name, body) {
    return this.surface.current(name, () => this.library.call(name, body));
  }

  // Returns tier, version, renderer, bufferBytes and aoBytes.
  get info() {
    return this.library.info("nook_gl_describe", "nook_gl_info", (info) => this.library.module._nook_gl_describe(this.handle, info));
  }
  // Returns the number of WebGL objects that the library holds in this context, for tests.
  get objectCount() {
    return this.surface.objectCount;
  }

  // Call this on "webglcontextlost". Then destroy all objects, and create them again on "webglcontextrestored".
  contextLost() {
    this.library.check(this.library.module._nook_gl_context_lost(this.handle));
    this.surface.lose();
  }
  destroy() {
    // If the context was lost and the host has not reported it, the library would delete objects that no longer exist.
    if (this.address && this.surface.isLost) this.contextLost();
    super.destroy();
  }
  #sceneOf(scene) {
    return this.library.handleOf(scene, "scene", Scene, "Scene");
  }

  prepare(scene) {
    this.#current("nook_gl_scene_prepare", () => this.library.check(this.library.module._nook_gl_scene_prepare(this.handle, this.#sceneOf(scene))));
  }
  // Evaluates the AO of all instances of a scene.
  update(scene) {
    this.#current("nook_gl_scene_update", () => this.library.check(this.library.module._nook_gl_scene_update(this.handle, this.#sceneOf(scene))));
  }
  release(scene) {
    this.#current("nook_gl_scene_release", () => this.library.check(this.library.module._nook_gl_scene_release(this.handle, this.#sceneOf(scene))));
  }

  // Returns where an instance's values are, for vertexAttribPointer: { buffer, offset, stride, count, texture, light, glsl }.
  // channel: "ao", or "directional-ao" for an instance with a light. Only "directional-ao" has texture and light.
  view(scene, instance, channel = "ao") {
    const name = "nook_gl_scene_view";
    this.surface.alive(name);
    checkIndex(name, "instance", instance);
    const handle = this.library.call(name, () => this.#sceneOf(scene)), number = this.#channel(name, channel);
    const view = this.library.info(name, "nook_gl_view", (at) =>
      this.library.module._nook_gl_scene_view(this.handle, handle, instance, number, at));
    return { ...view, buffer: this.surface.object("buffers", view.buffer), texture: this.surface.object("textures", view.texture) };
  }
  #channel(call, name) {
    const { layouts } = this.library;
    return layouts.number(layouts.constants.get("nook_channel").numbers, name, "the channel", call);
  }

  // Copies the AO of the last update to a buffer or texture of the host: { buffer or texture, format, offset, instanceStride,
  // textureWidth }.
  writeAo(scene, instances, to) {
    const { library } = this, name = "nook_gl_scene_write";
    this.surface.alive(name);
    checkNumbers(name, "instances", instances, { whole: true });
    checkObject(name, "target", to, "an object such as { buffer }");
    const { buffer, texture, ...target } = to;
    checkWebGL(name, "buffer", buffer, ["WebGLBuffer"]);
    checkWebGL(name, "texture", texture, ["WebGLTexture"]);
    this.surface.lend([["buffers", buffer], ["textures", texture]], (bufferName, textureName) => this.#current(name, () => {
      const handle = this.#sceneOf(scene);
      const description = library.struct("nook_gl_ao_target", { ...target, buffer: bufferName, texture: textureName });
      library.check(library.module._nook_gl_scene_write(this.handle, handle, library.integers(instances), instances.length, description));
    }));
  }

  // For tests: reads the values, and waits for the GPU. There is one number for each vertex, or three for "directional-ao".
  read(scene, instance, channel = "ao", out) {
    const name = "nook_gl_scene_read";
    return this.#current(name, () => {
      const handle = this.#sceneOf(scene), number = this.#channel(name, channel);
      checkIndex(name, "instance", instance);
      const count = scene.vertexCount(instance), numbers = channel === "ao" ? 1 : 3;
      return this.library.readFloats(name, numbers * count, out, (address) =>
        this.library.module._nook_gl_scene_read(this.handle, handle, instance, number, address, count));
    });
  }

  // options: { maxWidth, maxHeight, preset, taps, halfResolution, blur, blurSharpness, network }.
  createNnao(options) {
    const { library } = this;
    return makeOnSurface(Nnao, library, this.surface, "nook_nnao_create", () => {
      checkObject(library.name, "options", options, "an object such as { maxWidth, maxHeight }");
      const { network, ...others } = options;
      if (network !== undefined && network !== null) checkBytes(library.name, "network", network);
      library.layouts.check(library.layouts.struct("nook_nnao_desc"), others, library.name);
      return (out) => {
        const bytes = network ? library.bytes(network) : { address: 0, size: 0 };
        return library.module._nook_nnao_create(this.handle,
          library.descriptor("nook_nnao_desc", { ...others, network: bytes.address, networkSize: bytes.size }), out);
      };
    });
  }
  // Uploads a probe or a grid. form: "lobes" (default), "sh" or "zh3".
  uploadProbe(probe, form = "lobes") {
    const { library } = this;
    return makeOnSurface(Upload, library, this.surface, "nook_gl_upload_probe", () => {
      const { numbers } = library.layouts.constants.get("nook_gl_probe_form");
      const number = library.layouts.number(numbers, form, "the form", library.name);
      const handle = library.handleOf(probe, "probe", Probe, "Probe");
      return (out) => library.module._nook_gl_upload_probe(this.handle, handle, number, out);
    });
  }
  uploadMaterial(material) {
    const { library } = this;
    return makeOnSurface(Upload, library, this.surface, "nook_gl_upload_material", () => {
      const handle = library.handleOf(material, "material", Material, "Material");
      return (out) => library.module._nook_gl_upload_material(this.handle, handle, out);
    });
  }
}

// A probe, a grid or a material as textures, and the GLSL that reads them; see nook_gl.h.
export class Upload extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_upload_destroy", surface);
  }
  // Replaces the probe. Only for uploads of probes.
  update(probe) {
    const { library } = this;
    const name = "nook_gl_update_probe";
    this.surface.current(name, () => library.call(name, () => library.check(
      library.module._nook_gl_update_probe(this.handle, library.handleOf(probe, "probe", Probe, "Probe")))));
  }
  // Returns { textures, bytes, glsl, constant, constantValues, constantVec4s, walls }. Each texture is { target, texture,
  // uniform }.
  get info() {
    this.surface.alive("nook_gl_upload_describe");
    const info = this.library.info("nook_gl_upload_describe", "nook_gl_upload_info", (at) => this.library.module._nook_gl_upload_describe(this.handle, at));
    const textures = info.textures.slice(0, info.textureCount)
      .map((each) => ({ ...each, texture: this.surface.object("textures", each.texture) }));
    return { ...info, textures };
  }
  // Prepares a draw with a program of the host. Leaves the program in use, and the textures bound from unit firstUnit on.
  bind(program, firstUnit = 0) {
    this.surface.alive("nook_gl_upload_bind");
    checkWebGL("nook_gl_upload_bind", "program", program, ["WebGLProgram"]);
    checkIndex("nook_gl_upload_bind", "firstUnit", firstUnit);
    const gl = this.surface.context;
    const { textures, constant, constantValues, constantVec4s } = this.info;
    gl.useProgram(program);
    textures.forEach(({ target, texture, uniform }, index) => {
      gl.activeTexture(gl.TEXTURE0 + firstUnit + index);
      gl.bindTexture(target, texture);
      gl.bindSampler(firstUnit + index, null);
      gl.uniform1i(gl.getUniformLocation(program, uniform), firstUnit + index);
    });
    if (constantVec4s > 0) gl.uniform4fv(gl.getUniformLocation(program, constant), constantValues.subarray(0, 4 * constantVec4s));
    else if (constant) gl.uniform1i(gl.getUniformLocation(program, constant), constantValues[0]);
  }
}
