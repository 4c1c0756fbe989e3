// The frames of the animation, drawn and timed.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "platform/render_target.h"
#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/screen_space.h"

namespace crowd {

// All that is drawn, owned by main.
struct Stage {
  const platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  platform::RenderTarget& target;
  ScreenSpaceAo* screen_space;  // null: none
};

// Milliseconds by the wall clock, each stage waited for: means over the frames after the first.
struct FrameTimes {
  double pose = 0, scene_update = 0, screen_space = 0, draw = 0, read = 0;
};

struct FrameRequest {
  std::uint32_t frames = 4;
  std::filesystem::path out;
  const Light* light = nullptr;  // null: plain ambient light and a key light
};

std::vector<Bones> pose_crowd(const Hero& hero, const std::vector<Placement>& places, float time_s);
// A muted colour that stays with a character.
glm::vec3 albedo_of(std::size_t character);
// Farthest root from the origin, with room for the body.
float crowd_radius_m(const std::vector<Placement>& places);

// The instances as they stand, with what the scene's last update left of each; lit: it saw a light of all.
std::vector<DrawnInstance> drawn_crowd(const CrowdScene& scene, const std::vector<Bones>& poses, bool lit);
// How a picture under the light of all characters is made: exposed for a surface that faces up, behind
// everything the light from the horizon ahead.
ProbeLight probe_light(const CrowdScene& scene, const Light& light, const Camera& camera);

// Writes frame_0000.png and so on; calls progress with the number of frames done.
FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

}  // namespace crowd
