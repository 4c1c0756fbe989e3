// The scenes of nook-lab-motion. A scene says which bodies move, where they stand, which clips they play, and
// where the camera is.
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
  float phase = 0;  // position in the clip in the first frame, from 0 to 1
  int cycles = 1;   // number of cycles of the clip in one loop of the animation
  glm::vec3 shirt{0.6f};
};

// A camera that draws one picture of each frame.
struct Shot {
  std::string name;
  Camera camera;
  float height = 1;  // height of the picture divided by its width
};

struct MotionScene {
  std::vector<Mover> movers;
  std::vector<Shot> shots;
  glm::vec2 floor_travel_m{0};  // how far the floor moves under the bodies in one loop of the animation
  nook::lab::crowd::FloorPatch floor;  // the part of the floor whose light is ray traced
};

std::vector<std::string> motion_scene_names();
MotionScene motion_scene(std::string_view name);

// Returns the poses at the time `part` of the loop, from 0 to 1. Throws std::runtime_error if the hero does
// not have a clip that the scene names.
std::vector<Bones> poses_of(const Hero& hero, const MotionScene& scene, float part);

}  // namespace crowd::lab
