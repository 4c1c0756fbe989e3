// Draws the frames of the animation, measures their times, and records the frames of the screen-space pass.
#pragma once

#include <functional>

#include "bakers/lab/crowd/debug_shapes.h"
#include "bakers/lab/crowd/plain_look.h"
#include "platform/render_target.h"
#include "samples/crowd/places.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {

// The objects that every picture is drawn with. main() owns them.
struct Stage {
  const platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  PlainRenderer& plain;
  platform::RenderTarget& target;
  ScreenPasses* passes;  // null: no AO on the floor
};

// Wall-clock times in milliseconds. They are means over the frames, without the first frame. Each stage waits
// for the GPU.
struct FrameTimes {
  double pose = 0, scene_update = 0, screen_space = 0, draw = 0, read = 0;
};

struct FrameRequest {
  std::uint32_t frames = 4;
  std::filesystem::path out;
  const Light* light = nullptr;  // null: plain ambient light and a key light
  // The folder in which each frame of the screen-space pass is recorded, as frame_0000.nook and so on. If
  // empty, nothing is recorded. `nook evaluate nnao --frame` replays the files.
  std::filesystem::path record;
  DebugView debug;  // drawn over each frame
};

// Writes frame_0000.png and so on. After each frame, calls `progress` with the number of finished frames.
FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

// Returns a counter of the world pass in the last frame, averaged over the pixels that show a surface. Waits
// for the GPU.
double mean_count(const GladGLContext& gl, ScreenPasses& passes, nook_world_view view);
// Compares the world pass of the last frame with a pass at full resolution that evaluates every caster at
// every pixel. Returns the rms difference over the pixels that show a surface. Waits for the GPU.
double rms_to_every_caster(const GladGLContext& gl, ScreenPasses& passes, const nook::Gl& nook_gl);

}  // namespace crowd::lab
