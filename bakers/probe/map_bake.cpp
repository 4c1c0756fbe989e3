#include "bakers/probe/map_bake.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::bake::probe {

Samples bake_samples(const Environment& map, const MapBakeSettings& settings) {
  const Region region = region_of(settings.basis);
  Sampling sampling = settings.sampling;
  if (sampling == Sampling::automatic)
    sampling = nook::probe::is_running(settings.fit.method) ? Sampling::luminance : Sampling::texels;
  switch (sampling) {
    case Sampling::luminance:
      return luminance_samples(map, LightSampler(map, uniform_share), region, settings.samples,
                               settings.seed);
    case Sampling::uniform:
      return uniform_samples(map, region, settings.samples, settings.seed);
    default:
      return texel_samples(map, region, settings.seed);
  }
}

std::vector<Vec3> bake_map(const MapBakeSettings& settings, const Samples& samples,
                           const std::function<bool(std::size_t, std::size_t)>& progress) {
  constexpr std::size_t block = 1u << 14;
  nook::probe::Fit fit(settings.basis, settings.fit);
  for (std::size_t first = 0; first < samples.size(); first += block) {
    add_samples(fit, samples, first, std::min(block, samples.size() - first));
    if (progress && !progress(std::min(first + block, samples.size()), samples.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while fitting (%zu of %zu samples done)", first,
                    samples.size());
  }
  std::vector<Vec3> coefficients(settings.basis.count);
  fit.read(coefficients);
  return coefficients;
}

}  // namespace nook::bake::probe
