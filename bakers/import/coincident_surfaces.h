// Finds surfaces that lie on each other, such as levels of detail without telling names, or bodies that were
// exported twice. They hide each other from the sky, so that the AO of both is wrong.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// The triangles of an import, grouped by the primitives that they come from.
struct SurfaceParts {
  struct Part {
    std::uint32_t node = 0, primitive = 0;  // of the file; instances of a mesh have the same
    std::size_t end_triangle = 0;           // one past the last triangle; the first follows the previous part
  };
  std::vector<Part> all;
};

// Two nodes, or two primitives of one node, that face the same way and lie on each other.
struct CoincidentPair {
  std::uint32_t node[2] = {}, primitive[2] = {};  // the second has fewer triangles, or as many
  float cover[2] = {};                            // share of the area that the other covers
};

// Looks along the normals of samples of each part, as far as 2 % of its size. There are at most 2^16 samples,
// or 16 per part. The time is linear in the triangles, times the logarithm of the samples.
std::vector<CoincidentPair> coincident_surfaces(const SurfaceParts& parts, std::span<const Vec3> position,
                                                std::span<const std::array<std::uint32_t, 3>> triangle);

// Adds one sentence for each pair, at most four. It names both and the one to leave out.
void warn_of_coincident_surfaces(const tinygltf::Model& model, const SurfaceParts& parts,
                                 std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle,
                                 std::vector<std::string>& warnings);

}  // namespace nook::bake
