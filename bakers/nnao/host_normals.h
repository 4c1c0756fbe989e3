// Normals like the ones that hosts draw into their G-buffers. They differ from triangle normals, because they
// are interpolated over a coarse mesh or come from normal maps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/nnao/solids.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

// Finds vertices with the same position.

// Returns an index for each position, counted from 0. Equal positions get equal indices.
struct Places {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};
Places weld(std::span<const Vec3> positions);

// The maximum angle between a host's normal and the triangle's normal: 25 degrees, in radians.
inline constexpr float max_normal_tilt = 0.436332f;

class HostNormals {
 public:
  // The soup must outlive this object. `size` is the size of the scene's objects (TrainingScene::size).
  // `seed` selects the pattern and depth of the normal map. It also decides whether there is a normal map,
  // smooth normals or both.
  HostNormals(const TriangleSoup& soup, float size, std::uint64_t seed);

  // Returns the unit normal where a ray hits, in world space. It faces the viewer.
  Vec3 at(const RayHit& hit, Vec3 origin, Vec3 direction) const;

 private:
  Vec3 smooth(const RayHit& hit) const;
  Vec3 corner_normal(std::uint32_t place, Vec3 face) const;

  const TriangleSoup& soup_;
  std::uint64_t seed_;
  bool smooth_ = false;
  float map_depth_ = 0, map_scale_ = 1;        // tangent of the maximum tilt; waves per metre
  std::vector<std::uint32_t> place_;           // per vertex
  std::vector<std::uint32_t> first_, around_;  // triangles around each place
  std::vector<Vec3> area_;                     // per triangle: normal times area
};

}  // namespace nook::bake::nnao
