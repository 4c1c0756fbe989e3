// Maps that tests can know everything about.
#pragma once

#include <vector>

#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/hemisphere.h"

namespace nook::test {

// A map whose texels hold f at their centres.
template <class F>
bake::Environment map_of(std::uint32_t width, std::uint32_t height, F&& f) {
  const bake::Environment frame(width, height, std::vector<float>(3 * std::size_t(width) * height));
  std::vector<float> rgb;
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const Vec3 value = f(frame.direction(column, row, 0.5f, 0.5f));
      rgb.insert(rgb.end(), {value.x, value.y, value.z});
    }
  return bake::Environment(width, height, std::move(rgb));
}

// Noise, a bright side and a lamp of a hundred times the mean.
inline bake::Environment uneven_map() {
  std::uint64_t key = 5;
  bake::Environment map = map_of(64, 32, [&](Vec3 d) {
    const auto noise = [&] { return 0.5f + bake::unit_float(bake::mix_bits(key++)); };
    const float side = 1 + (d.x > 0.5f ? 2.0f : 0.0f), lamp = d.y > 0.9f && d.z > 0.1f ? 100.0f : 0.0f;
    return Vec3{side * noise() + lamp, side * noise() + lamp, 0.5f * side * noise()};
  });
  return map;
}

}  // namespace nook::test
