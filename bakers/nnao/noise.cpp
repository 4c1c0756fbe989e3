#include "bakers/nnao/noise.h"

#include <cmath>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::nnao {
namespace {

float lattice(std::uint64_t seed, int x, int y, int z) {
  const auto word = [](int i) { return std::uint64_t(std::uint32_t(i) & 0x1fffffu); };
  return 2 * unit_float(mix_bits(seed ^ mix_bits(word(x) << 42 | word(y) << 21 | word(z)))) - 1;
}

float mixed(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

float value_noise(std::uint64_t seed, Vec3 p) {
  const Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const auto fade = [](float t) { return t * t * (3 - 2 * t); };
  const float u = fade(p.x - low.x), v = fade(p.y - low.y), w = fade(p.z - low.z);
  const int x = int(low.x), y = int(low.y), z = int(low.z);
  const auto along_x = [&](int j, int k) {
    return mixed(lattice(seed, x, y + j, z + k), lattice(seed, x + 1, y + j, z + k), u);
  };
  return mixed(mixed(along_x(0, 0), along_x(1, 0), v), mixed(along_x(0, 1), along_x(1, 1), v), w);
}

float fractal_noise(std::uint64_t seed, Vec3 p, int octaves) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(seed + std::uint64_t(octave), p);
    weight *= 0.5f;
    p = 2.03f * p;
  }
  return sum;
}

}  // namespace nook::bake::nnao
