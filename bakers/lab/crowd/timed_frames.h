// Draws the frames of the animation, times them, and records the frames of the screen-space pass.
#pragma once

#include <functional>

#include "bakers/lab/crowd/debug_shapes.h"
#include "bakers/lab/crowd/plain_look.h"
#include "platform/render_target.h"
#include "samples/crowd/places.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {

// What every picture is drawn with. main owns it.
struct Stage {
  const platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  PlainRenderer& plain;
  platform::RenderTarget& target;
  ScreenPasses* passes;  // null without AO on the floor
};

// Milliseconds of the wall clock; each stage waits for the GPU. Means over the frames after the first.
struct FrameTimes {
  double pose = 0, scene_update = 0, screen_space = 0, draw = 0, read = 0;
};

struct FrameRequest {
  std::uint32_t frames = 4;
  std::filesystem::path out;
  const Light* light = nullptr;  // null for plain ambient light and a key light
  // Folder to record each frame of the screen-space pass in, as frame_0000.nook and so on; empty: none. `nook
  // evaluate nnao --frame` replays them.
  std::filesystem::path record;
  DebugView debug;  // drawn over each frame
};

// Writes frame_0000.png and so on, and calls progress with the number of frames that are done.
FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

// Returns the mean over pixels with a surface of a number that the world pass counts in the last frame. Waits
// for the GPU.
double mean_count(const GladGLContext& gl, ScreenPasses& passes, nook_world_view view);
// Compares the world pass in the last frame with one of full resolution that evaluates every caster
// everywhere. Returns the rms difference over pixels with a surface. Waits for the GPU.
double rms_to_every_caster(const GladGLContext& gl, ScreenPasses& passes, const nook::Gl& nook_gl);

}  // namespace crowd::lab
