// Seeded noise in space, for surfaces that are not smooth.
#pragma once

#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

// Value noise on the lattice of whole numbers with a smooth fade, in [-1, 1].
float value_noise(std::uint64_t seed, Vec3 p);

// A sum of octaves, each half as large as the one before and of twice its frequency.
float fractal_noise(std::uint64_t seed, Vec3 p, int octaves);

}  // namespace nook::bake::nnao
