// Scenes that the lab builds itself.
#pragma once

#include <array>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/scene_families.h"

namespace nook::lab {

// Makes a scene of thin objects on a floor in front of a wall: a fence, a wire mesh, bentwood chairs, a plant
// with blades and leaves, and a hand. The training scenes do not contain such objects. They are difficult for
// methods that know only one depth per pixel. The same seed gives the same scene.
bake::nnao::TrainingScene make_thin_scene(std::uint64_t seed);

// Returns the room in which a moving body is measured, in world space, in metres. The floor is at y = 0. The
// body walks through the origin, and a wall is behind its path. Skirting, crates, a table and a chair stand
// along the wall, and a thin post stands in front.
bake::TriangleSoup mover_stage();

// A camera, and the walking direction of the body that the camera shows.
struct MoverShot {
  const char* name;
  Vec3 eye, target;
  float fov = 0;      // vertical, radians
  float heading = 0;  // see WalkSettings
};
std::array<MoverShot, 4> mover_shots();

}  // namespace nook::lab
