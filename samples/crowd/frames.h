// Draws the frames of the animation and times them.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "platform/render_target.h"
#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/debug_view.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/screen_space.h"

namespace crowd {

// The state that every picture is drawn with. main owns it.
struct Stage {
  const platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  platform::RenderTarget& target;
  ScreenSpaceAo* screen_space;  // null without screen-space AO
};

// Milliseconds of the wall clock, where each stage waits for the GPU. Means over the frames after the first.
struct FrameTimes {
  double pose = 0, scene_update = 0, screen_space = 0, draw = 0, read = 0;
};

struct FrameRequest {
  std::uint32_t frames = 4;
  std::filesystem::path out;
  const Light* light = nullptr;  // null for plain ambient light and a key light
  std::filesystem::path record;  // empty, or where each frame of the screen-space pass is recorded
  DebugView debug;               // drawn over each frame
};

// The instances in their poses, with what the scene's last update left of each. If lit, all of them had a
// light in that update.
std::vector<DrawnInstance> drawn_crowd(const CrowdScene& scene, const std::vector<Bones>& poses, bool lit);
// The look of a picture in the light of all characters. It is exposed for a surface that faces up, and its
// background is the light from the horizon ahead.
ProbeLight probe_light(const CrowdScene& scene, const Light& light, const Camera& camera);

// Writes frame_0000.png and so on, and calls progress with the number of frames that are done.
FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

}  // namespace crowd
