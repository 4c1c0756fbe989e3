// Nook's screen-space AO for the crowd: depth and normals drawn ahead of the lighting, and the pass over
// them.
#pragma once

#include <nook/nook_nnao.h>

#include <nook/nook.hpp>

#include "platform/platform.h"
#include "samples/crowd/renderer.h"

namespace crowd {

struct ScreenSpaceQuality {
  int taps = 64;
  bool half_resolution = false;
};

// 16 taps at half resolution where the processor draws, else the defaults.
ScreenSpaceQuality quality_for(const std::string& gl_renderer);

class ScreenSpaceAo {
 public:
  static constexpr float kRadius_m = 0.5f;

  // gl must be of the same OpenGL context; draw needs it, the destructor does not.
  ScreenSpaceAo(const platform::Context& context, nook_gl gl, int width_px, int height_px);
  ~ScreenSpaceAo();
  ScreenSpaceAo(const ScreenSpaceAo&) = delete;
  ScreenSpaceAo& operator=(const ScreenSpaceAo&) = delete;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const ScreenSpaceQuality& quality() const { return quality_; }

  // NOOK_NNAO_LAYER_REPLACE: 1 on characters, whose vertices have AO that counts already what the pass would
  // count again; the lighting multiplies the two. NOOK_NNAO_LAYER_NONE: on characters as well. Leaves
  // another framebuffer bound.
  ScreenAo draw(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                nook_nnao_layer layer = NOOK_NNAO_LAYER_REPLACE);

 private:
  enum Texture { kDepth, kNormals, kLayer, kTextures };

  const GladGLContext& gl_;
  int width_px_, height_px_;
  ScreenSpaceQuality quality_;
  GLuint textures_[kTextures] = {};
  GLuint framebuffer_ = 0;
  nook::Unique<nook_nnao, nook_nnao_destroy> pass_;
};

}  // namespace crowd
