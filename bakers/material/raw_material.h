// Uncompressed appearance of a material: what is traced or measured, what compression is judged by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Last index fastest. Texel (x, y) covers [x, x + 1] / width times [y, y + 1] / height of the tile.
struct RawMaterial {
  std::string name;
  std::vector<Vec3> lights, views;  // unit, tile space
  std::uint32_t width = 0, height = 0;
  // BTF: (3 light + channel) x view x width x height, radiance as in sdk's material/material.h, of what the
  // view meets; where it passes through, as fill_gaps.h has it.
  std::vector<float> btf;
  // VOTF: view x width x height, 1 where the view meets the meso-structure, 0 where it passes through; empty:
  // all 1.
  std::vector<float> mask;
  // Heights over the plane z = 0 in tiles, x * height + y; empty: not known.
  std::vector<float> heights;

  std::size_t texels() const { return std::size_t(width) * height; }
  std::size_t light_rows() const { return 3 * lights.size(); }
};

// Rounds the BTF to half floats, in which files hold it.
void round_to_halves(RawMaterial& raw);

}  // namespace nook::bake::material
