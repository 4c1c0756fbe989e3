// Coordinate textures of made numbers, for tests of what reads them.
#pragma once

#include <cstdint>

#include "sdk/src/synthesis/coordinates.h"

namespace nook::synthesis::test {

inline Coordinates sample_coordinates(std::uint32_t side = 8, std::uint32_t width = 6,
                                      std::uint32_t height = 4) {
  Coordinates coordinates;
  coordinates.side = side;
  coordinates.width = width;
  coordinates.height = height;
  std::uint32_t state = 7;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    state = state * 1664525u + 1013904223u;
    coordinates.cells.push_back({std::uint16_t((state >> 8) % width), std::uint16_t((state >> 20) % height)});
  }
  coordinates.recipe = "{\"seed\":1}";
  return coordinates;
}

}  // namespace nook::synthesis::test
