// A room to stand characters in: walls, steps, a table with chairs, a shelf.
#pragma once

#include "bakers/raytrace/ray_scene.h"

namespace nook::measure {

// World space, metres, the floor at y = 0.
bake::TriangleSoup own_room();

}  // namespace nook::measure
