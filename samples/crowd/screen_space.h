// Nook's AO for the floor of the crowd: depth and normals are drawn before the lighting, and the screen-space
// pass reads them, then the world pass, by whose casters the characters darken the floor.
#pragma once

#include <nook/nook.hpp>

#include "platform/platform.h"
#include "samples/crowd/light.h"
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

  // The texture has 1 on characters: the lighting multiplies it with the AO of their vertices, which already
  // has what the passes would count again. The instances are those of the scene, by whose casters they darken
  // the floor once: the screen-space pass leaves them out. Leaves another framebuffer bound.
  // With a light, which must outlive the next draw, red, green and blue are the open shares of its soft part,
  // and alpha is that of its sun.
  ScreenAo draw(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                nook_scene scene, const SplitLight* light = nullptr);
  // The screen-space pass alone. With NOOK_GBUFFER_AO_NONE the texture has its AO on characters too.
  ScreenAo draw_screen(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                       nook_gbuffer_ao layer);

  // The mean of a number that the last frame of draw counts at a pixel with a surface. Waits for the GPU.
  double mean_count(nook_world_view view);

  // The rms of the difference between the world pass in the last frame of draw and one of full resolution
  // that evaluates every caster everywhere, over pixels with a surface. Waits for the GPU.
  double rms_to_every_caster(const nook::Gl& gl);

  // Records the frame that was drawn last. Waits for the GPU.
  nook::Recording record(const char* note) { return pass_.record(frame_, desc_, note); }

 private:
  enum Texture { kDepth, kNormals, kLayer, kTextures };

  // One number of each pixel of a frame, and whether a surface is there.
  std::vector<float> read_red(GLuint texture) const;
  std::vector<bool> read_surfaces() const;

  const GladGLContext& gl_;
  int width_px_, height_px_;
  ScreenSpaceQuality quality_;
  GLuint textures_[kTextures] = {};
  GLuint framebuffer_ = 0;
  nook::Nnao pass_;
  nook::WorldPass world_;
  nook_nnao_frame_desc desc_{};          // of the last draw
  nook_gl_frame_desc frame_{};           // of the last draw
  nook_world_frame_desc world_frame_{};  // the same
};

}  // namespace crowd
