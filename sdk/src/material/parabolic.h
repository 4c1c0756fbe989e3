// The parabolic map from the hemisphere to a square, by W. Heidrich, H.-P. Seidel: Realistic,
// Hardware-accelerated Shading and Lighting, 1999. shaders/material/parabolic.glsl has the same functions.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::material {

// A point of the map. The hemisphere covers the disc x^2 + y^2 <= 1.
struct ParabolicPoint {
  float x = 0, y = 0;
};

// Returns the point of a direction. A direction below the horizon is first moved onto the horizon.
inline ParabolicPoint to_parabolic(Vec3 d) {
  const float scale = 1 / (d.z > 0 ? 1 + d.z : std::max(std::sqrt(d.x * d.x + d.y * d.y), 1e-6f));
  return {d.x * scale, d.y * scale};
}

// Returns the direction of a point. For a point outside the disc, returns the nearest direction of the
// horizon.
inline Vec3 from_parabolic(ParabolicPoint p) {
  const float square = p.x * p.x + p.y * p.y;
  if (square >= 1) {
    const float radius = std::sqrt(square);
    return {p.x / radius, p.y / radius, 0};
  }
  return Vec3{2 * p.x, 2 * p.y, 1 - square} * (1 / (1 + square));
}

// Returns the centre of a cell of the side x side map.
inline ParabolicPoint cell_centre(std::uint32_t column, std::uint32_t row, std::uint32_t side) {
  return {2 * (float(column) + 0.5f) / float(side) - 1, 2 * (float(row) + 0.5f) / float(side) - 1};
}

// Returns the cell that contains a direction, row * side + column.
inline std::size_t cell_of(Vec3 d, std::uint32_t side) {
  const ParabolicPoint p = to_parabolic(d);
  const auto index = [&](float at) {
    const float place = std::clamp(0.5f * at + 0.5f, 0.0f, 1.0f) * float(side);
    return std::min(static_cast<std::uint32_t>(place), side - 1);
  };
  return std::size_t(index(p.y)) * side + index(p.x);
}

}  // namespace nook::material
