// The place that a moving body is measured in: a floor with a wall and things beside the way.
#pragma once

#include <array>

#include "bakers/nnao/cameras.h"

namespace nook::measure {

// The floor is at y = 0, the wall behind the way, which leads through the origin: half a metre of skirting,
// crates, a table and a chair along the wall, a thin post before it. World space, metres.
bake::TriangleSoup mover_stage();

// A camera, and where the body that it follows goes.
struct MoverShot {
  const char* name;
  Vec3 eye, target;
  float fov = 0;      // vertical, radians
  float heading = 0;  // see WalkSettings
};
std::array<MoverShot, 4> mover_shots();

}  // namespace nook::measure
