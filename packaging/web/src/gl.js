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
    return makeOnSurface(Gl, library, surface, (out) => library.module._nook_gl_create(context,
      library.descriptor("nook_gl_desc", { stateMode: "defaults", ...options, getProc: library.module._nook_web_get_proc() }), out));
  }
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_destroy", surface);
  }

  #current(body) {
    return this.surface.current(() => this.library.call(body));
  }

  // tier, version, renderer, bufferBytes, aoBytes.
  get info() {
    return this.library.info("nook_gl_info", (info) => this.library.module._nook_gl_describe(this.handle, info));
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
    this.#current(() => this.library.check(this.library.module._nook_gl_scene_prepare(this.handle, scene.handle)));
  }
  // Evaluates the AO of all instances of a scene.
  update(scene) {
    this.#current(() => this.library.check(this.library.module._nook_gl_scene_update(this.handle, scene.handle)));
  }
  release(scene) {
    this.#current(() => this.library.check(this.library.module._nook_gl_scene_release(this.handle, scene.handle)));
  }

  // The place of an instance's AO: { buffer, offset, stride, count } for vertexAttribPointer.
  aoBuffer(scene, instance) {
    const view = this.library.info("nook_gl_ao_view", (at) =>
      this.library.module._nook_gl_scene_ao_buffer(this.handle, scene.handle, instance, at));
    return { ...view, buffer: this.surface.object("buffers", view.buffer) };
  }
  // The place of an instance's directional occlusion and of the lights: { buffer, offset, stride, count, texture, light, glsl }.
  light(scene, instance) {
    const view = this.library.info("nook_gl_light_view", (at) =>
      this.library.module._nook_gl_scene_light(this.handle, scene.handle, instance, at));
    return { ...view, buffer: this.surface.object("buffers", view.buffer), texture: this.surface.object("textures", view.texture) };
  }

  // Copies the AO of the last update to a buffer or texture of the host: { buffer or texture, format, offset, instanceStride,
  // textureWidth }.
  writeAo(scene, instances, { buffer, texture, ...target }) {
    const { library } = this;
    this.surface.lend([["buffers", buffer], ["textures", texture]], (bufferName, textureName) => this.#current(() =>
      library.check(library.module._nook_gl_scene_write_ao(this.handle, scene.handle, library.integers(instances), instances.length,
        library.struct("nook_gl_ao_target", { ...target, buffer: bufferName, texture: textureName })))));
  }

  // For tests: waits for the GPU.
  readAo(scene, instance, out) {
    const count = scene.vertexCount(instance);
    return this.#current(() => this.library.readFloats(count, out, (address) =>
      this.library.module._nook_gl_scene_read_ao(this.handle, scene.handle, instance, address, count)));
  }
  readDirectionalAo(scene, instance, out) {
    const count = scene.vertexCount(instance);
    return this.#current(() => this.library.readFloats(3 * count, out, (address) =>
      this.library.module._nook_gl_scene_read_directional_ao(this.handle, scene.handle, instance, address, count)));
  }

  // { maxWidth, maxHeight, taps, halfResolution, blur, blurSharpness, network }.
  createNnao({ network, ...options }) {
    const { library } = this;
    return makeOnSurface(Nnao, library, this.surface, (out) => {
      const bytes = network ? library.bytes(network) : { address: 0, size: 0 };
      return library.module._nook_nnao_create(this.handle,
        library.descriptor("nook_nnao_desc", { ...options, network: bytes.address, networkSize: bytes.size }), out);
    });
  }
  createProbe(probe) {
    const { library } = this;
    return makeOnSurface(GlProbe, library, this.surface, (out) =>
      library.module._nook_gl_probe_create(this.handle, probe.handle, out));
  }
  createMaterial(material, options = {}) {
    const { library } = this;
    return makeOnSurface(GlMaterial, library, this.surface, (out) => library.module._nook_gl_material_create(
      this.handle, material.handle, library.descriptor("nook_gl_material_desc", options), out));
  }
}

// A probe as a texture, and the GLSL that evaluates it; see nook_gl_probe.h.
export class GlProbe extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_probe_destroy", surface);
  }
  update(probe) {
    const { library } = this;
    this.surface.current(() => library.check(library.module._nook_gl_probe_update(this.handle, probe.handle)));
  }
  // { texture, bytes, glsl }.
  get info() {
    const info = this.library.info("nook_gl_probe_info", (at) => this.library.module._nook_gl_probe_describe(this.handle, at));
    return { ...info, texture: this.surface.object("textures", info.texture) };
  }
}

// A material as textures, and the GLSL that decodes them; see nook_gl_material.h.
export class GlMaterial extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_gl_material_destroy", surface);
  }
  // { textureCount, textureBytes, glsl }.
  get info() {
    return this.library.info("nook_gl_material_info", (at) => this.library.module._nook_gl_material_describe(this.handle, at));
  }
  // { target, texture, uniform } each.
  get textures() {
    return Array.from({ length: this.info.textureCount }, (_, index) => {
      const info = this.library.info("nook_gl_material_texture", (at) =>
        this.library.module._nook_gl_material_describe_texture(this.handle, index, at));
      return { ...info, texture: this.surface.object("textures", info.texture) };
    });
  }
}
