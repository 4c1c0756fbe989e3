#include "raytrace/hemisphere.h"

#include <cmath>
#include <numbers>

namespace nook::bake {

HemispherePatterns::HemispherePatterns(std::uint32_t rays, std::uint64_t seed)
    : rays_(rays), directions_(std::size_t(rays) * pattern_count) {
  std::uint32_t rows = std::uint32_t(std::sqrt(float(rays)));
  while (rows > 1 && rays % rows != 0) --rows;
  const std::uint32_t columns = rays / rows;
  std::uint64_t counter = mix_bits(seed);
  for (std::uint32_t p = 0; p < pattern_count; ++p) {
    for (std::uint32_t i = 0; i < rays; ++i) {
      const float u = (float(i % rows) + unit_float(mix_bits(counter++))) / float(rows);
      const float v = (float(i / rows) + unit_float(mix_bits(counter++))) / float(columns);
      // Malley's method: uniform on the disc, projected up.
      const float radius = std::sqrt(u);
      const float angle = 2 * std::numbers::pi_v<float> * v;
      directions_[std::size_t(p) * rays + i] = {radius * std::cos(angle), radius * std::sin(angle),
                                                std::sqrt(std::max(0.0f, 1 - u))};
    }
  }
}

}  // namespace nook::bake
