// A prefiltered cube map, which is the usual representation of glossy light. Each level is for one roughness.
// It stores the light that a mirror of this roughness reflects towards a viewer straight above it (B. Karis,
// Real Shading in Unreal Engine 4, 2013). For other views, the map is read in the dominant direction of the
// reflection (S. Lagarde, C. de Rousiers, Moving Frostbite to PBR, 2014). The result is multiplied by the
// surface's albedo.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sdk/src/probe/ggx_reflection.h"

namespace nook::lab {

class PrefilteredCube {
 public:
  // `size` must be a power of 2. Faces have `size` x `size` texels for roughness 0.1. Each level has half the
  // size of the one before, down to one texel for roughness 1. `light` returns the radiance from a unit
  // direction.
  PrefilteredCube(std::uint32_t size, const std::function<Vec3(Vec3)>& light);

  // Returns the mean light over the lobe of a surface. If the surface has two widths, their mean is used.
  // Interpolates between levels and between texels, also across face edges.
  Vec3 reflected(const probe::Surface& surface) const;
  // Returns the size of all levels in the format RGB9E5, with 4 bytes per texel.
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
