// Scenes that the lab builds itself.
#pragma once

#include <array>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/scene_families.h"

namespace nook::lab {

// Makes a scene of thin objects on a floor in front of a wall: a fence, a wire mesh, bentwood chairs, a plant
// with blades and leaves, and a hand. No training scene contains them. They are difficult for methods with
// one depth per pixel. The scene depends only on the seed.
bake::nnao::TrainingScene make_thin_scene(std::uint64_t seed);

// Returns the room in which a moving body is measured, in world space and metres. The floor is at y = 0. The
// body's path leads through the origin, and a wall is behind the path. Skirting, crates, a table and a chair
// stand along the wall, and a thin post stands in front.
bake::TriangleSoup mover_stage();

// A camera, and the walking direction of the body that it follows.
struct MoverShot {
  const char* name;
  Vec3 eye, target;
  float fov = 0;      // vertical, radians
  float heading = 0;  // see WalkSettings
};
std::array<MoverShot, 4> mover_shots();

}  // namespace nook::lab
