// Evaluates the relief of a material on the CPU: finds the texel that a view sees through a point of the
// plane z = 0. shaders/material/btf.glsl has the same function.
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
  std::uint32_t width = 0, height = 0, levels = 0;  // the size of `heights`; 0 for a plane
  // Half floats, from 0 at `low` to 1 at `high`. Mipmap levels are stored one after another. A texel is the
  // mean height over its area.
  Vector<std::uint16_t> heights;

  bool moves() const { return low != 0 || high != 0; }
};

// Pass the width and height of the BTF.
ReliefTables make_relief_tables(const Relief& relief, std::uint32_t width, std::uint32_t height,
                                Memory* memory);

struct TexturePlace {
  float u = 0, v = 0;
};

// A point above the plane z = 0 appears shifted in a view. Returns the shift per unit of height. Its length
// is the tangent of the view's angle to the normal, at most max_slope.
TexturePlace relief_slope(const ReliefTables& relief, Vec3 view);

// Marches along the view's ray through (u, v, 0), from the highest plane to the lowest in equal steps. The
// last step interpolates linearly. Returns the point of the tile above which the ray first meets the relief.
// `level` is the mipmap level of the heights, 0 or more. Views that are tilted beyond max_slope are treated
// as if their slope were max_slope.
TexturePlace relief_place(const ReliefTables& relief, TexturePlace at, float level, Vec3 view);

}  // namespace nook::material
