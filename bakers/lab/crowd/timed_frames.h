// Draws the frames of the animation, times them, and records the frames of the screen-space pass.
#pragma once

#include <functional>

#include "bakers/lab/crowd/debug_shapes.h"
#include "bakers/lab/crowd/plain_look.h"
#include "platform/render_target.h"
#include "samples/crowd/places.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {

// The state that every picture is drawn with. main owns it.
struct Stage {
  const platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  PlainRenderer& plain;
  platform::RenderTarget& target;
  ScreenPasses* passes;  // null without AO on the floor
};

// Milliseconds of the wall clock, where each stage waits for the GPU. Means over the frames after the first.
struct FrameTimes {
  double pose = 0, scene_update = 0, screen_space = 0, draw = 0, read = 0;
};

struct FrameRequest {
  std::uint32_t frames = 4;
  std::filesystem::path out;
  const Light* light = nullptr;  // null for plain ambient light and a key light
  // Empty, or where each frame of the screen-space pass is recorded: frame_0000.nook and so on, which
  // `nook evaluate nnao --frame` replays.
  std::filesystem::path record;
  DebugView debug;  // drawn over each frame
};

// Writes frame_0000.png and so on, and calls progress with the number of frames that are done.
FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

// The mean of a number that the world pass counts at a pixel with a surface in the last frame. Waits for the
// GPU.
double mean_count(const GladGLContext& gl, ScreenPasses& passes, nook_world_view view);
// The rms of the difference between the world pass in the last frame and one of full resolution that
// evaluates every caster everywhere, over pixels with a surface. Waits for the GPU.
double rms_to_every_caster(const GladGLContext& gl, ScreenPasses& passes, const nook::Gl& nook_gl);

}  // namespace crowd::lab
