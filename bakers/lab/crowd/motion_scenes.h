// The scenes of nook-lab-motion: who moves where, by which clip, and from where the camera looks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/lab/crowd/truth.h"
#include "samples/crowd/camera.h"
#include "samples/crowd/hero.h"

namespace crowd::lab {

struct Mover {
  std::string clip;
  float x_m = 0, z_m = 0, yaw_rad = 0;
  float phase = 0;  // from 0 to 1, in the first frame
  int cycles = 1;   // of the clip, in one loop of the animation
  glm::vec3 shirt{0.6f};
};

// One picture of each frame.
struct Shot {
  std::string name;
  Camera camera;
  float height = 1;  // in widths of the picture
};

struct MotionScene {
  std::vector<Mover> movers;
  std::vector<Shot> shots;
  glm::vec2 floor_travel_m{0};         // the way of the floor under the movers in one loop
  nook::lab::crowd::FloorPatch floor;  // where the floor is traced
};

std::vector<std::string> motion_scene_names();
MotionScene motion_scene(std::string_view name);

// The poses at a part of the loop, from 0 to 1. Throws std::runtime_error if the hero has no such clip.
std::vector<Bones> poses_of(const Hero& hero, const MotionScene& scene, float part);

}  // namespace crowd::lab
