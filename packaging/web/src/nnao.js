import { OnSurface } from "./on_surface.js";

// The screen-space pass; see nook_nnao.h.
export class Nnao extends OnSurface {
  constructor(library, handle, surface) {
    super(library, handle, "nook_nnao_destroy", surface);
  }

  // { texture, textureBytes, taps, ... }; texture is the result where the target is the pass's own.
  get info() {
    const info = this.library.info("nook_nnao_info", (at) => this.library.module._nook_nnao_describe(this.handle, at));
    return { ...info, texture: this.surface.object("textures", info.texture) };
  }
  get texture() {
    return this.info.texture;
  }

  // The members of nook_nnao_frame_desc in camelCase. depthTexture, normalTexture, layerTexture and motionTexture are WebGLTextures; target is
  // a WebGLTexture, a WebGLFramebuffer, null for the canvas, or nothing for the pass's own texture.
  render({ depthTexture, normalTexture, layerTexture, motionTexture, target, ...frame }) {
    const { library, surface } = this;
    const kind = target === undefined ? "own" : target && "WebGLTexture" in globalThis && target instanceof WebGLTexture
      ? "texture" : "framebuffer";
    const table = kind === "texture" ? "textures" : "framebuffers";
    surface.lend([["textures", depthTexture], ["textures", normalTexture], ["textures", layerTexture], ["textures", motionTexture],
      [table, target]],
      (depth, normal, layer, motion, name) => surface.current(() => library.call(() => library.check(library.module._nook_nnao_render(
        this.handle, library.descriptor("nook_nnao_frame_desc", {
          ...frame, depthTexture: depth, normalTexture: normal, layerTexture: layer, motionTexture: motion, target: kind, targetName: name,
        }))))));
  }
  // Call it after a texture of the host has been given another size or format.
  recheck() {
    this.library.check(this.library.module._nook_nnao_recheck(this.handle));
  }
}
