#include "bakers/raytrace/hemisphere.h"

#include <cmath>

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
      directions_[std::size_t(p) * rays + i] = cosine_direction(u, v);
    }
  }
}

}  // namespace nook::bake
