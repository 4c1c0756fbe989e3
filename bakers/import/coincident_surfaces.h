// Finds surfaces that lie on each other, such as levels of detail whose names do not say so, or bodies that
// were exported twice. Each surface blocks the sky for the other, so the AO of both is wrong. In the same
// way, a hull that draws an outline blocks the sky for the body inside it.
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
    std::uint32_t node = 0,
                  primitive = 0;   // indices in the file; all instances of a mesh have the same primitive
    std::size_t end_triangle = 0;  // one past the last triangle; the first follows the previous part
  };
  std::vector<Part> all;
};

// Two nodes, or two primitives of one node, that face the same way and lie on each other.
struct CoincidentPair {
  std::uint32_t node[2] = {},
                primitive[2] = {};  // the second part has at most as many triangles as the first
  float cover[2] = {};              // share of the area of each part that the other part covers
};

// A node or primitive that surrounds another surface and whose faces point inwards. Toon models draw their
// outlines with such a hull.
struct OutlineHull {
  std::uint32_t node = 0, primitive = 0;  // if is_whole_node is true, ignore the primitive
  bool is_whole_node = false;
  std::uint32_t inner_node = 0, inner_primitive = 0;  // the largest surface inside the hull
  float cover = 0;                                    // share of the inner surface that the hull covers
};

struct CloseSurfaces {
  std::vector<CoincidentPair> pairs;
  std::vector<OutlineHull> hulls;
};

// Samples each part and searches along the normals of the samples, up to a distance of 2 % of its size. There
// are at most 2^16 samples, or 16 per part. The time is O(triangles * log(samples)).
CloseSurfaces close_surfaces(const SurfaceParts& parts, std::span<const Vec3> position,
                             std::span<const std::array<std::uint32_t, 3>> triangle);

// Adds one sentence for each pair and one for each hull, at most four of each kind. A sentence names both
// surfaces, and says which one to leave out of the bake. Returns the hulls.
std::vector<OutlineHull> warn_of_close_surfaces(const tinygltf::Model& model, const SurfaceParts& parts,
                                                std::span<const Vec3> position,
                                                std::span<const std::array<std::uint32_t, 3>> triangle,
                                                std::vector<std::string>& warnings);

}  // namespace nook::bake
