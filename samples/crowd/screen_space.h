// Nook's screen-space AO for the crowd: depth and normals are drawn before the lighting, and the pass reads
// them.
#pragma once

#include <nook/nook_nnao.h>

#include <nook/nook.hpp>

#include "platform/platform.h"
#include "samples/crowd/renderer.h"

namespace crowd {

struct ScreenSpaceQuality {
  int taps = 32;
  bool half_resolution = false;
};

// Software renderers get 16 taps at half resolution, and others 32 taps.
ScreenSpaceQuality quality_for(const std::string& gl_renderer);

class ScreenSpaceAo {
 public:
  static constexpr float kRadius_m = 0.5f;

  // gl must belong to the same OpenGL context. draw needs it, and the destructor does not.
  ScreenSpaceAo(const platform::Context& context, const nook::Gl& gl, int width_px, int height_px);
  ~ScreenSpaceAo();
  ScreenSpaceAo(const ScreenSpaceAo&) = delete;
  ScreenSpaceAo& operator=(const ScreenSpaceAo&) = delete;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const ScreenSpaceQuality& quality() const { return quality_; }

  // With NOOK_NNAO_LAYER_REPLACE the texture has 1 on characters: the lighting multiplies it with the AO of
  // their vertices, which already has what the pass would count again. With NOOK_NNAO_LAYER_NONE the texture
  // has screen-space AO on characters too. Leaves another framebuffer bound.
  ScreenAo draw(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                nook_nnao_layer layer = NOOK_NNAO_LAYER_REPLACE);

  // Records the frame that was drawn last. Waits for the GPU.
  nook::Recording record(const char* note) { return pass_.record(frame_, note); }

 private:
  enum Texture { kDepth, kNormals, kLayer, kTextures };

  const GladGLContext& gl_;
  int width_px_, height_px_;
  ScreenSpaceQuality quality_;
  GLuint textures_[kTextures] = {};
  GLuint framebuffer_ = 0;
  nook::Nnao pass_;
  nook_nnao_frame_desc frame_{};  // of the last draw
};

}  // namespace crowd
