// The relief of a material on the CPU: which texel a view sees through a point of the plane z = 0.
// shaders/material/host.glsl has the same function.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/material.h"

namespace nook::material {

struct ReliefTables {
  explicit ReliefTables(Memory* memory = default_memory()) : heights(memory) {}

  float low = 0, high = 0, max_slope = 0;  // as in Relief
  std::uint32_t steps = 0;
  std::uint32_t width = 0, height = 0, levels = 0;  // of the heights, 0 of a plane
  // Half floats, 0 at low to 1 at high: one mipmap level after another, each the mean over its texels' areas.
  Vector<std::uint16_t> heights;

  bool moves() const { return low != 0 || high != 0; }
};

// width and height are those of the BTF.
ReliefTables make_relief_tables(const Relief& relief, std::uint32_t width, std::uint32_t height,
                                Memory* memory);

struct TexturePlace {
  float u = 0, v = 0;
};

// The shift of a point for a height of 1 in a view: the tangent of its tilt, at most max_slope, along it.
TexturePlace relief_slope(const ReliefTables& relief, Vec3 view);

// Marches from the highest plane to the lowest along the view's ray through (u, v, 0), in equal steps with a
// linear last one, and returns the point of the tile over which the ray first meets the relief. Heights are
// those of a mipmap level, 0 or more. Views beyond max_slope move texels as far as those at it.
TexturePlace relief_place(const ReliefTables& relief, TexturePlace at, float level, Vec3 view);

}  // namespace nook::material
