// The scenes that the lab builds itself.
#pragma once

#include <array>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/scene_families.h"

namespace nook::lab {

// Thin objects, which no training scene contains and which are difficult for methods with one depth for each
// pixel: a picket fence and a wire mesh, bentwood chairs, a plant with blades and leaves, and a hand, on a
// floor with a wall behind them. The same seed gives the same scene.
bake::nnao::TrainingScene make_thin_scene(std::uint64_t seed);

// The place that a moving body is measured in: the floor is at y = 0, the wall behind the way, which leads
// through the origin: half a metre of skirting, crates, a table and a chair along the wall, a thin post
// before it. World space, metres.
bake::TriangleSoup mover_stage();

// A camera, and where the body that it follows goes.
struct MoverShot {
  const char* name;
  Vec3 eye, target;
  float fov = 0;      // vertical, radians
  float heading = 0;  // see WalkSettings
};
std::array<MoverShot, 4> mover_shots();

}  // namespace nook::lab
