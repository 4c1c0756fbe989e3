#include "bakers/material/tile_noise.h"

#include <cmath>
#include <numbers>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::material {
namespace {

Vec3 lattice_gradient(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t cells,
                      std::uint64_t seed) {
  const auto wrap = [cells](std::int64_t i) { return std::uint64_t((i % cells + cells) % cells); };
  const std::uint64_t bits =
      mix_bits(seed ^ mix_bits(wrap(x) | wrap(y) << 20 | std::uint64_t(z + (1 << 20)) << 40));
  const float height = 2 * unit_float(bits) - 1;
  const float angle = 2 * std::numbers::pi_v<float> * unit_float(mix_bits(bits));
  const float radius = std::sqrt(1 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

float tile_noise(Vec3 p, std::uint32_t cells, std::uint64_t seed) {
  const Vec3 q = p * float(cells);
  const Vec3 base{std::floor(q.x), std::floor(q.y), std::floor(q.z)};
  const Vec3 f = q - base;
  float corner[8];
  for (int i = 0; i < 8; ++i) {
    const Vec3 offset{float(i & 1), float(i >> 1 & 1), float(i >> 2)};
    const Vec3 gradient = lattice_gradient(std::int64_t(base.x + offset.x), std::int64_t(base.y + offset.y),
                                           std::int64_t(base.z + offset.z), cells, seed);
    corner[i] = dot(gradient, f - offset);
  }
  const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const float low = mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v);
  const float high = mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v);
  // Unit gradients keep Perlin's noise within about +-0.87.
  return mix(low, high, w) / 0.87f;
}

float tile_fractal_noise(Vec3 p, std::uint32_t cells, std::uint32_t octaves, std::uint64_t seed) {
  float sum = 0, amplitude = 1;
  for (std::uint32_t i = 0; i < octaves; ++i, cells *= 2, amplitude /= 2)
    sum += amplitude * tile_noise(p, cells, seed + i);
  return sum;
}

}  // namespace nook::bake::material
