// Vertices that lie at one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

// Returns for each position the index of a place; equal positions have equal indices, which count from 0.
struct Places {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};
Places weld(std::span<const Vec3> positions);

}  // namespace nook::bake::nnao
