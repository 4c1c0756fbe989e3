// Bakes one probe from one environment map.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/probe/map_light.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/fit.h"

namespace nook::bake::probe {

// Samples of a map that a probe is fitted to.

struct Samples {
  std::vector<float> direction, radiance;  // 3 per sample
  std::vector<float> weight;               // 1 / (area of the region * sampling density)

  std::size_t size() const { return weight.size(); }
  void add(Vec3 sample_direction, Vec3 sample_radiance, float sample_weight);
};

void add_samples(nook::probe::Fit& fit, const Samples& samples, std::size_t first, std::size_t count);

// Draws independent directions, uniform over the region.
Samples uniform_samples(const Environment& map, const Region& region, std::size_t count, std::uint64_t seed);

// Draws half of the directions in proportion to luminance and half uniformly, all independently. So no weight
// is more than twice the weight of a uniform sample.
inline constexpr float uniform_share = 0.5f;
Samples luminance_samples(const Environment& map, const LightSampler& sampler, const Region& region,
                          std::size_t count, std::uint64_t seed);

// Returns every texel of the region once, in random order, weighted by its solid angle.
Samples texel_samples(const Environment& map, const Region& region, std::uint64_t seed);

enum class Sampling : std::uint8_t {
  automatic = 0,  // texels for methods that solve a system; luminance for running averages, which a sun in a
                  // late sample would spoil
  texels = 1,     // every texel once, in random order
  luminance = 2,  // half in proportion to luminance, half uniformly
  uniform = 3
};

struct MapBakeSettings {
  nook::probe::Basis basis;
  nook::probe::FitSettings fit;
  Sampling sampling = Sampling::automatic;
  std::uint32_t samples = 1u << 20;  // number of samples for luminance and uniform
  std::uint64_t seed = 1;
};

// Draws the samples of a bake with the method that settings.sampling selects.
Samples bake_samples(const Environment& map, const MapBakeSettings& settings);

// Returns one coefficient per basis function. `progress` counts samples. If it returns false, bake_map throws
// Failure(NOOK_ERROR_CANCELLED).
std::vector<Vec3> bake_map(const MapBakeSettings& settings, const Samples& samples,
                           const std::function<bool(std::size_t done, std::size_t total)>& progress = {});
inline std::vector<Vec3> bake_map(
    const Environment& map, const MapBakeSettings& settings,
    const std::function<bool(std::size_t done, std::size_t total)>& progress = {}) {
  return bake_map(settings, bake_samples(map, settings), progress);
}

// Returns the amplitudes for glossy reflection (sdk/src/probe/gloss.h). They leave out the suns of the map,
// because a host draws suns as lights. `basis` must be Gaussians. Integrals are exact, whatever method the
// bake uses.
std::vector<Vec3> map_gloss(const Environment& map, const nook::probe::Basis& basis);

}  // namespace nook::bake::probe
