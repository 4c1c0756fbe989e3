// A prefiltered cube map, the usual form of glossy light. For a few roughnesses, it stores what a mirror of
// that roughness reflects if seen straight on (B. Karis, Real Shading in Unreal Engine 4, 2013). Other views
// read it in the dominant direction of their reflection (S. Lagarde, C. de Rousiers, Moving Frostbite to PBR,
// 2014), and the surface's albedo multiplies it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sdk/src/probe/ggx_reflection.h"

namespace nook::lab {

class PrefilteredCube {
 public:
  // size is a power of 2. Faces have size x size texels for the roughness 0.1, and halve down to one texel
  // for the roughness 1. light returns the radiance from a unit direction.
  PrefilteredCube(std::uint32_t size, const std::function<Vec3(Vec3)>& light);

  // Returns the mean of the light over the lobe of a surface with the mean width. Blends between levels and
  // between texels, also over edges of faces.
  Vec3 reflected(const probe::Surface& surface) const;
  // Counts all levels in the format RGB9E5, 4 bytes for each texel.
  std::size_t bytes() const;

 private:
  struct Level {
    std::uint32_t size;
    std::vector<Vec3> texels;
  };
  static Vec3 at(const Level& level, Vec3 direction);

  std::vector<Level> levels_;
};

}  // namespace nook::lab
