// Finds surfaces that lie on each other, such as levels of detail without telling names, or bodies that were
// exported twice. They hide each other from the sky, so that the AO of both is wrong. Hulls that draw
// outlines hide the body inside.
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

// A node, or a primitive of it, that lies around another surface with its faces turned inside: the hull that
// draws the outline of a toon.
struct OutlineHull {
  std::uint32_t node = 0, primitive = 0;  // the primitive counts unless is_whole_node
  bool is_whole_node = false;
  std::uint32_t inner_node = 0, inner_primitive = 0;  // the largest inside; a primitive of the same node
  float cover = 0;                                    // share of the area inside that the hull covers
};

struct CloseSurfaces {
  std::vector<CoincidentPair> pairs;
  std::vector<OutlineHull> hulls;
};

// Looks along the normals of samples of each part, as far as 2 % of its size. There are at most 2^16 samples,
// or 16 per part. The time is linear in the triangles, times the logarithm of the samples.
CloseSurfaces close_surfaces(const SurfaceParts& parts, std::span<const Vec3> position,
                             std::span<const std::array<std::uint32_t, 3>> triangle);

// Adds one sentence for each pair and one for each hull, at most four of both. It names both and the one to
// leave out. Returns the hulls.
std::vector<OutlineHull> warn_of_close_surfaces(const tinygltf::Model& model, const SurfaceParts& parts,
                                                std::span<const Vec3> position,
                                                std::span<const std::array<std::uint32_t, 3>> triangle,
                                                std::vector<std::string>& warnings);

}  // namespace nook::bake
