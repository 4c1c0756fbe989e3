// Scenes that the lab builds itself.
#pragma once

#include <array>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/scene_families.h"

namespace nook::lab {

// Makes a scene of thin objects on a floor in front of a wall: a fence, a wire mesh, bentwood chairs, a plant
// with blades and leaves, and a hand. No training scene contains them. They are difficult for methods with
// one depth per pixel. The same seed gives the same scene.
bake::nnao::TrainingScene make_thin_scene(std::uint64_t seed);

// The place where a moving body is measured. The floor is at y = 0, and the wall is behind the way, which
// leads through the origin. Half a metre of skirting, crates, a table and a chair are along the wall, with a
// thin post in front. World space, metres.
bake::TriangleSoup mover_stage();

// A camera, and the way of the body that it follows.
struct MoverShot {
  const char* name;
  Vec3 eye, target;
  float fov = 0;      // vertical, radians
  float heading = 0;  // see WalkSettings
};
std::array<MoverShot, 4> mover_shots();

}  // namespace nook::lab
