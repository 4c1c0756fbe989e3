import { OnSurface } from "./on_surface.js";

// The screen-space pass; see nook_nnao.h.
export class Nnao extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_nnao_destroy", surface);
  }

  // { texture, textureBytes, taps, ... }; texture is the result where the target is the pass's own.
  get info() {
    const info = this.library.info("nook_nnao_describe", "nook_nnao_info", (at) => this.library.module._nook_nnao_describe(this.handle, at));
    return { ...info, texture: this.surface.object("textures", info.texture) };
  }
  get texture() {
    return this.info.texture;
  }

  // The members of nook_gl_frame_desc and nook_nnao_frame_desc in camelCase. depthTexture, normalTexture, gbufferAoTexture and motionVectors are
  // WebGLTextures; target is a WebGLTexture, a WebGLFramebuffer, null for the canvas, or nothing for the pass's own texture.
  render({ depthTexture, normalTexture, gbufferAoTexture, motionVectors, target, radius, radiusKind, sceneSize, maxRadiusPx, intensity, power,
    motionVectorScale, reset, minRadiusPx, fadeBegin, fadeEnd, show, ...frame }) {
    const { library, surface } = this;
    const kind = target === undefined ? "own" : target && "WebGLTexture" in globalThis && target instanceof WebGLTexture
      ? "texture" : "framebuffer";
    const table = kind === "texture" ? "textures" : "framebuffers";
    surface.lend([["textures", depthTexture], ["textures", normalTexture], ["textures", gbufferAoTexture], ["textures", motionVectors],
      [table, target]],
      (depth, normal, layer, motion, name) => surface.current(() => library.call("nook_nnao_render", () => library.check(library.module._nook_nnao_render(
        this.handle, library.descriptor("nook_gl_frame_desc", {
          ...frame, depthTexture: depth, normalTexture: normal, gbufferAoTexture: layer, target: kind, targetName: name,
        }), library.descriptor("nook_nnao_frame_desc", {
          radius, radiusKind, sceneSize, maxRadiusPx, intensity, power, motionVectors: motion, motionVectorScale, reset, minRadiusPx, fadeBegin, fadeEnd,
          next: show ? library.descriptor("nook_nnao_frame_debug_desc", { show }) : undefined,
        }))))));
  }
}
