import { NookError } from "./error.js";
import { Nnao } from "./nnao.js";
import { OnSurface, makeOnSurface } from "./on_surface.js";
import { Surface } from "./surface.js";

// A WebGL 2 context that the library draws in; see nook_gl.h.
export class Gl extends OnSurface {
  static make(library, context, webgl, options = {}) {
    if (!webgl || typeof webgl.createTransformFeedback !== "function")
      throw new NookError("Context.createGl: webgl is no WebGL2RenderingContext; call canvas.getContext(\"webgl2\")",
        "NOOK_ERROR_UNSUPPORTED");
    const surface = Surface.of(library.module.GL, webgl);
    return makeOnSurface(Gl, library, surface, "nook_gl_create", (out) => library.module._nook_gl_create(context,
      library.descriptor("nook_gl_desc", { stateMode: "defaults", ...options, getProc: library.module._nook_web_get_proc() }), out));
  }
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_destroy", surface);
  }

  #current(name, body) {
    return this.surface.current(() => this.library.call(name, body));
  }

  // tier, version, renderer, bufferBytes, aoBytes.
  get info() {
    return this.library.info("nook_gl_describe", "nook_gl_info", (info) => this.library.module._nook_gl_describe(this.handle, info));
  }
  // The number of WebGL objects that the library holds in this context, for tests.
  get objectCount() {
    return this.surface.objectCount;
  }

  // Call it on "webglcontextlost"; afterwards destroy everything, and make it anew on "webglcontextrestored".
  contextLost() {
    this.library.check(this.library.module._nook_gl_context_lost(this.handle));
    this.surface.forget();
  }

  prepare(scene) {
    this.#current("nook_gl_scene_prepare", () => this.library.check(this.library.module._nook_gl_scene_prepare(this.handle, scene.handle)));
  }
  // Evaluates the AO of all instances of a scene.
  update(scene) {
    this.#current("nook_gl_scene_update", () => this.library.check(this.library.module._nook_gl_scene_update(this.handle, scene.handle)));
  }
  release(scene) {
    this.#current("nook_gl_scene_release", () => this.library.check(this.library.module._nook_gl_scene_release(this.handle, scene.handle)));
  }

  // The place of an instance's values, for vertexAttribPointer: { buffer, offset, stride, count, texture, light, glsl }. channel: "ao",
  // or "directional-ao" of an instance with a light; texture and light are for the latter.
  view(scene, instance, channel = "ao") {
    const view = this.library.info("nook_gl_scene_view", "nook_gl_view", (at) =>
      this.library.module._nook_gl_scene_view(this.handle, scene.handle, instance, this.#channel(channel), at));
    return { ...view, buffer: this.surface.object("buffers", view.buffer), texture: this.surface.object("textures", view.texture) };
  }
  #channel(name) {
    const { layouts } = this.library;
    return layouts.number(layouts.constants.get("nook_channel").numbers, name, "the channel");
  }

  // Copies the AO of the last update to a buffer or texture of the host: { buffer or texture, format, offset, instanceStride,
  // textureWidth }.
  writeAo(scene, instances, { buffer, texture, ...target }) {
    const { library } = this;
    this.surface.lend([["buffers", buffer], ["textures", texture]], (bufferName, textureName) => this.#current("nook_gl_scene_write", () =>
      library.check(library.module._nook_gl_scene_write(this.handle, scene.handle, library.integers(instances), instances.length,
        library.struct("nook_gl_ao_target", { ...target, buffer: bufferName, texture: textureName })))));
  }

  // For tests: waits for the GPU. One number for each vertex, three for "directional-ao".
  read(scene, instance, channel = "ao", out) {
    const count = scene.vertexCount(instance), numbers = channel === "ao" ? 1 : 3;
    return this.#current("nook_gl_scene_read", () => this.library.readFloats("nook_gl_scene_read", numbers * count, out, (address) =>
      this.library.module._nook_gl_scene_read(this.handle, scene.handle, instance, this.#channel(channel), address, count)));
  }

  // { maxWidth, maxHeight, preset, taps, halfResolution, blur, blurSharpness, network }.
  createNnao({ network, ...options }) {
    const { library } = this;
    return makeOnSurface(Nnao, library, this.surface, "nook_nnao_create", (out) => {
      const bytes = network ? library.bytes(network) : { address: 0, size: 0 };
      return library.module._nook_nnao_create(this.handle,
        library.descriptor("nook_nnao_desc", { ...options, network: bytes.address, networkSize: bytes.size }), out);
    });
  }
  // A probe or a grid in a form: "lobes" (default), "sh" or "zh3".
  uploadProbe(probe, form = "lobes") {
    const { library } = this;
    const { numbers } = library.layouts.constants.get("nook_gl_probe_form");
    const number = library.layouts.number(numbers, form, "the form");
    return makeOnSurface(Upload, library, this.surface, "nook_gl_upload_probe", (out) =>
      library.module._nook_gl_upload_probe(this.handle, probe.handle, number, out));
  }
  uploadMaterial(material) {
    const { library } = this;
    return makeOnSurface(Upload, library, this.surface, "nook_gl_upload_material", (out) =>
      library.module._nook_gl_upload_material(this.handle, material.handle, out));
  }
}

// A probe, a grid or a material as textures, and the GLSL that reads them; see nook_gl.h.
export class Upload extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_upload_destroy", surface);
  }
  // Replaces the probe of an upload of a probe.
  update(probe) {
    const { library } = this;
    this.surface.current(() => library.check(library.module._nook_gl_update_probe(this.handle, probe.handle)));
  }
  // { textures: { target, texture, uniform } each, bytes, glsl, constant, constantValues, constantVec4s, walls }.
  get info() {
    const info = this.library.info("nook_gl_upload_describe", "nook_gl_upload_info", (at) => this.library.module._nook_gl_upload_describe(this.handle, at));
    const textures = info.textures.slice(0, info.textureCount)
      .map((each) => ({ ...each, texture: this.surface.object("textures", each.texture) }));
    return { ...info, textures };
  }
  // Prepares a draw with a program of the host: leaves the program in use, and the textures bound from unit firstUnit on.
  bind(program, firstUnit = 0) {
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
