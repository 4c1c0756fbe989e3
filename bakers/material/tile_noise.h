// Gradient noise that repeats along x and y.
#pragma once

#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Perlin's noise, about -1 to 1, with `cells` lattice cells along a tile's side; repeats after 1 along x and
// y, not along z.
float tile_noise(Vec3 p, std::uint32_t cells, std::uint64_t seed);

// Octaves of it, each of twice the frequency and half the amplitude.
float tile_fractal_noise(Vec3 p, std::uint32_t cells, std::uint32_t octaves, std::uint64_t seed);

}  // namespace nook::bake::material
