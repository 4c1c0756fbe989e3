// Rooms, characters that stand in them, and cameras that look at them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/nnao/cameras.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::measure {

// Makes a room with walls, steps, a table, chairs and a shelf. World space, metres, the floor at y = 0.
bake::TriangleSoup own_room();

// Reads the triangles of a glTF file with +y up. `metres_per_unit` is the length of the file's unit in
// metres. Appends the warnings of the import to the given list. Throws Failure: BAD_FILE, or INVALID_ARGUMENT
// if a name of the mesh selection does not match any mesh.
bake::TriangleSoup room_of(const std::filesystem::path& file, float metres_per_unit,
                           const bake::ImportOptions& reading, std::vector<std::string>& warnings);

// A placed character. World space, metres, +y up.
struct Figure {
  bake::Pose pose;
  std::vector<Vec3> body;  // vertices
  Vec3 foot;               // on the floor, below the middle of the body
};

// Places up to `count` figures on level ground, with some distance to the room's surfaces and to each other.
// Their poses are picked at even intervals. The same seed gives the same places.
std::vector<Figure> stand_in_room(const bake::TriangleSoup& room, const bake::SkinnedMesh& mesh,
                                  std::span<const bake::Pose> poses, std::size_t count, std::uint64_t seed);

// The room with its figures. Triangles from first_figure on belong to figures.
struct PopulatedRoom {
  bake::TriangleSoup soup;
  std::uint32_t first_figure = 0;
};
PopulatedRoom populated(const bake::TriangleSoup& room, const bake::SkinnedMesh& mesh,
                        std::span<const Figure> figures);

// Returns cameras 1.6 to 3.4 m from a figure that they see. There may be fewer than requested.
std::vector<bake::nnao::Camera> cameras_at(const PopulatedRoom& room, std::span<const Figure> figures,
                                           std::size_t count, std::uint32_t width, std::uint32_t height,
                                           std::uint64_t seed);

}  // namespace nook::measure
