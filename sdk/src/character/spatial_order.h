// An order of places in which those that are near each other are side by side, in blocks of equal size.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"

namespace nook {

// A position in metres, and three more coordinates in metres, which may be those of a scaled normal.
using Place = std::array<float, 6>;

// Orders `indices` of places. Every coordinate must be finite. All blocks are whole, except for the last.
void order_in_space(std::span<std::uint32_t> indices, std::size_t block, const Vector<Place>& places);

}  // namespace nook
