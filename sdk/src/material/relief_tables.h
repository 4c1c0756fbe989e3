// The relief of a material on the CPU. It finds the texel that a view sees through a point of the plane z =
// 0. shaders/material/host.glsl has the same function.
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
  std::uint32_t width = 0, height = 0, levels = 0;  // of the heights; 0 for a plane
  // Half floats, 0 at low to 1 at high. One mipmap level follows another; each averages its texels' areas.
  Vector<std::uint16_t> heights;

  bool moves() const { return low != 0 || high != 0; }
};

// width and height are the BTF's.
ReliefTables make_relief_tables(const Relief& relief, std::uint32_t width, std::uint32_t height,
                                Memory* memory);

struct TexturePlace {
  float u = 0, v = 0;
};

// Returns how far a point moves per unit of height in a view: the tangent of the view's tilt, at most
// max_slope, in the view's direction.
TexturePlace relief_slope(const ReliefTables& relief, Vec3 view);

// Marches from the highest plane to the lowest along the view's ray through (u, v, 0), in equal steps with a
// linear last one. Returns the point of the tile over which the ray first meets the relief. Heights come from
// a mipmap level, 0 or more. Views beyond max_slope move texels as far as views at max_slope.
TexturePlace relief_place(const ReliefTables& relief, TexturePlace at, float level, Vec3 view);

}  // namespace nook::material
