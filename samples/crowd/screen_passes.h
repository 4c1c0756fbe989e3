// The part of an engine that calls Nook for its floor. It draws depth and normals before the lighting. Then
// it runs the screen-space pass, and the world pass, in which the characters darken the floor.
#pragma once

#include <nook/nook.hpp>
#include <span>
#include <string>

#include "platform/platform.h"
#include "samples/crowd/crowd_renderer.h"
#include "samples/crowd/light.h"

namespace crowd {

// The defaults match NOOK_NNAO_PRESET_BEST, because a picture may take longer than a frame of a game.
struct ScreenQuality {
  int taps = 32;
  bool half_resolution = false;
};

class ScreenPasses {
 public:
  static constexpr float radius_m = 0.5f;

  // gl must belong to the same OpenGL context.
  ScreenPasses(const platform::Context& context, const nook::Gl& gl, int width, int height);
  ScreenPasses(const platform::Context& context, const nook::Gl& gl, int width, int height,
               const ScreenQuality& quality);
  ~ScreenPasses();
  ScreenPasses(const ScreenPasses&) = delete;
  ScreenPasses& operator=(const ScreenPasses&) = delete;

  const int width_px, height_px;
  const ScreenQuality quality;

  // The texture is 1 on characters, because the lighting multiplies it by the AO of their vertices, which
  // contains the same occlusion. The instances must be the instances of `scene`: its casters darken the
  // floor, and the screen-space pass leaves characters out. The call binds another framebuffer. With a light,
  // red, green and blue are the open shares of its soft part, and alpha is the open share of its sun. The
  // light must outlive the next draw.
  ScreenAo draw(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                nook_scene scene, const Light* light);
  // Draws only the screen-space pass. With NOOK_GBUFFER_AO_NONE, the texture has the pass's AO on characters
  // too.
  ScreenAo draw_screen(Renderer& renderer, std::span<const DrawnInstance> instances, const Camera& camera,
                       nook_gbuffer_ao layer);

  // The passes and their inputs in the last draw. With them, a program can evaluate the frame again, or
  // record it.
  nook::Nnao screen;
  nook::WorldPass world;
  nook_gl_frame_desc frame{};
  nook_nnao_frame_desc screen_frame{};
  nook_world_frame_desc world_frame{};

 private:
  enum Texture { depth, normals, layers, texture_count };

  const GladGLContext& gl_;
  GLuint textures_[texture_count] = {};
  GLuint framebuffer_ = 0;
};

// Software renderers get 16 taps at half resolution, and others 32 taps.
ScreenQuality quality_for(const std::string& gl_renderer);
nook_world_desc world_settings(int width, int height, const ScreenQuality& quality);

}  // namespace crowd
