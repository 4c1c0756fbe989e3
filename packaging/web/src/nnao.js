import { checkObject, checkWebGL } from "./arguments.js";
import { OnSurface } from "./on_surface.js";

// The screen-space pass; see nook_nnao.h.
export class Nnao extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_nnao_destroy", surface);
  }

  // Returns { texture, textureBytes, taps, ... }. `texture` has the result if the target is the pass's own texture.
  get info() {
    this.surface.alive("nook_nnao_describe");
    const info = this.library.info("nook_nnao_describe", "nook_nnao_info", (at) => this.library.module._nook_nnao_describe(this.handle, at));
    return { ...info, texture: this.surface.object("textures", info.texture) };
  }
  get texture() {
    return this.info.texture;
  }

  // `description` has the members of nook_gl_frame_desc and nook_nnao_frame_desc in camelCase. depthTexture, normalTexture,
  // gbufferAoTexture and motionVectors are WebGLTextures. target is a WebGLTexture, a WebGLFramebuffer, null for the canvas, or
  // undefined for the pass's own texture.
  render(description) {
    const { library, surface } = this, call = "nook_nnao_render";
    surface.alive(call);
    checkObject(call, "frame", description, "an object such as { depthTexture, width, height, projection, radius }");
    const { depthTexture, normalTexture, gbufferAoTexture, motionVectors, target, radius, radiusKind, sceneSize, maxRadiusPx, intensity, power,
      motionVectorScale, reset, minRadiusPx, fadeBegin, fadeEnd, show, ...frame } = description;
    for (const [argument, texture] of Object.entries({ depthTexture, normalTexture, gbufferAoTexture, motionVectors }))
      checkWebGL(call, argument, texture, ["WebGLTexture"]);
    checkWebGL(call, "target", target, ["WebGLTexture", "WebGLFramebuffer"]);
    const kind = target === undefined ? "own" : target && "WebGLTexture" in globalThis && target instanceof WebGLTexture
      ? "texture" : "framebuffer";
    const table = kind === "texture" ? "textures" : "framebuffers";
    surface.lend([["textures", depthTexture], ["textures", normalTexture], ["textures", gbufferAoTexture], ["textures", motionVectors],
      [table, target]], (depth, normal, layer, motion, name) => surface.current(call, () => library.call(call, () => {
      const debug = show === undefined ? undefined : library.prepared("nook_nnao_frame_debug_desc", { show });
      const images = library.prepared("nook_gl_frame_desc",
        { ...frame, depthTexture: depth, normalTexture: normal, gbufferAoTexture: layer, target: kind, targetName: name });
      const options = library.prepared("nook_nnao_frame_desc", {
        radius, radiusKind, sceneSize, maxRadiusPx, intensity, power, motionVectors: motion, motionVectorScale, reset, minRadiusPx, fadeBegin,
        fadeEnd, next: debug,
      });
      library.check(library.module._nook_nnao_render(this.handle, images(), options()));
    })));
  }
}
