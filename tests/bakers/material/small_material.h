// A raw material with structure along every mode, small enough to compress in a moment.
#pragma once

#include <cmath>

#include "bakers/material/raw_material.h"

namespace nook::bake::material::test {

inline RawMaterial small_material(std::uint32_t lights = 6, std::uint32_t views = 24,
                                  std::uint32_t width = 12, std::uint32_t height = 16) {
  RawMaterial raw;
  raw.name = "small";
  raw.lights = spiral_directions(lights);
  raw.views = spiral_directions(views);
  raw.width = width;
  raw.height = height;
  const float turn = 6.2831853f;
  for (std::size_t row = 0; row < raw.light_rows(); ++row)
    for (const Vec3 view : raw.views)
      for (std::uint32_t x = 0; x < width; ++x)
        for (std::uint32_t y = 0; y < height; ++y) {
          // Bumps whose image moves with the view, lit from the light.
          const Vec3 light = raw.lights[row / 3];
          const float u = turn * (float(x) / float(width) + 0.3f * view.x),
                      v = turn * (float(y) / float(height) + 0.3f * view.y);
          const float bump = light.z + 0.5f * light.x * std::cos(u) + 0.5f * light.y * std::sin(2 * v + u);
          raw.btf.push_back(std::max(bump, 0.0f) * (0.5f + 0.2f * float(row % 3)));
        }
  for (const Vec3 view : raw.views)
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::uint32_t y = 0; y < height; ++y) {
        const float u = turn * (float(x) / float(width) + 0.2f * view.x),
                    v = turn * (float(y) / float(height) + 0.2f * view.y);
        raw.mask.push_back(std::cos(u) + std::cos(v) > -0.8f * view.z ? 1.0f : 0.0f);
      }
  round_to_halves(raw);
  return raw;
}

}  // namespace nook::bake::material::test
