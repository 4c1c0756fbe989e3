// The lobes that reach each of a fixed set of directions.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/transfer/distant_light.h"

namespace nook::bake::transfer {

// The lobes that hold light from each direction, with their value times the direction's solid angle.
struct LobesOfDirections {
  std::vector<std::uint32_t> begin;  // of each direction, and one past the end
  std::vector<std::uint32_t> lobe;
  std::vector<float> weight;
  float integral = 0;  // of one lobe
};

LobesOfDirections lobes_of(const nook::transfer::CubeCells& cells, std::uint32_t lobes);

}  // namespace nook::bake::transfer
