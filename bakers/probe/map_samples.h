// Samples of a map as fits take them.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/probe/map_light.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/fit.h"

namespace nook::bake::probe {

struct Samples {
  std::vector<float> direction, radiance;  // 3 a sample
  std::vector<float> weight;               // 1 / (area of the region * density)

  std::size_t size() const { return weight.size(); }
  void add(Vec3 sample_direction, Vec3 sample_radiance, float sample_weight);
};

void add_samples(nook::probe::Fit& fit, const Samples& samples, std::size_t first, std::size_t count);

// Independent directions, uniform over the region.
Samples uniform_samples(const Environment& map, const Region& region, std::size_t count, std::uint64_t seed);

// Independent directions, half of them by luminance, so that no weight is above twice that of a uniform
// sample.
inline constexpr float uniform_share = 0.5f;
Samples luminance_samples(const Environment& map, const LightSampler& sampler, const Region& region,
                          std::size_t count, std::uint64_t seed);

// Every texel of the region once, in random order, weighted by its solid angle.
Samples texel_samples(const Environment& map, const Region& region, std::uint64_t seed);

}  // namespace nook::bake::probe
