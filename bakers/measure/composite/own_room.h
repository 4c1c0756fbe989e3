// Rooms to stand characters in.
#pragma once

#include <filesystem>

#include "bakers/raytrace/ray_scene.h"

namespace nook::measure {

// Walls, steps, a table with chairs, a shelf. World space, metres, the floor at y = 0.
bake::TriangleSoup own_room();

// The triangles of a glTF file with +y up, whose unit has so many metres. Throws Failure (BAD_FILE).
bake::TriangleSoup room_of(const std::filesystem::path& file, float metres_per_unit);

}  // namespace nook::measure
