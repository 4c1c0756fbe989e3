#include "bakers/probe/map_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/gloss.h"

namespace nook::bake::probe {
namespace {

Vec3 uniform_direction(float u, float v) {
  const float y = 1 - 2 * u, radius = std::sqrt(std::fmax(0.0f, 1 - y * y));
  const float angle = 2 * std::numbers::pi_v<float> * v;
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

// Returns the probability that a direction of the sampler lies in the region.
double probability(const Environment& map, const LightSampler& sampler, const Region& region) {
  double inside = 0;
  for (std::uint32_t row = 0; row < map.height(); ++row)
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      const Vec3 direction = map.direction(column, row, 0.5f, 0.5f);
      if (region.holds(direction)) inside += double(sampler.density(direction)) * map.solid_angle(row);
    }
  return inside;
}

}  // namespace

void Samples::add(Vec3 d, Vec3 f, float w) {
  direction.insert(direction.end(), {d.x, d.y, d.z});
  radiance.insert(radiance.end(), {f.x, f.y, f.z});
  weight.push_back(w);
}

void add_samples(nook::probe::Fit& fit, const Samples& samples, std::size_t first, std::size_t count) {
  fit.add_samples(&samples.direction[3 * first], &samples.radiance[3 * first], &samples.weight[first], count);
}

Samples uniform_samples(const Environment& map, const Region& region, std::size_t count, std::uint64_t seed) {
  Samples samples;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const float u = random.unit(), v = random.unit();
    Vec3 direction = uniform_direction(u, v);
    if (!region.holds(direction)) direction = -direction;
    samples.add(direction, map.radiance(direction), 1);
  }
  return samples;
}

Samples luminance_samples(const Environment& map, const LightSampler& sampler, const Region& region,
                          std::size_t count, std::uint64_t seed) {
  Samples samples;
  Random random(seed);
  const double inside = probability(map, sampler, region);
  const auto scale = float(inside / nook::probe::domain_area(region.domain));
  while (samples.size() < count) {
    const double choice = random.unit_double();
    const float alias = random.unit(), u = random.unit(), v = random.unit();
    const LightSample s = sampler.sample(choice, alias, u, v);
    if (region.holds(s.direction)) samples.add(s.direction, s.radiance, scale / s.density);
  }
  return samples;
}

Samples texel_samples(const Environment& map, const Region& region, std::uint64_t seed) {
  std::vector<std::uint32_t> order(map.texel_count());
  std::iota(order.begin(), order.end(), 0u);
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[std::min(std::size_t(random.unit_double() * double(i)), i - 1)]);
  const double scale = double(map.texel_count()) / (4 * std::numbers::pi);
  Samples samples;
  for (std::uint32_t texel : order) {
    const std::uint32_t row = texel / map.width(), column = texel % map.width();
    const Vec3 direction = map.direction(column, row, 0.5f, 0.5f);
    if (region.holds(direction))
      samples.add(direction, map.texel(texel), float(map.solid_angle(row) * scale));
  }
  return samples;
}

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

std::vector<Vec3> map_gloss(const Environment& map, const nook::probe::Basis& basis) {
  const std::uint32_t n = basis.count;
  const std::vector<Channels> moment = moments(without_suns(map), basis);
  const Vector<double> gram = nook::probe::basis_gram(basis);
  std::vector<Channels> amplitude(n);
  std::vector<double> scratch(nook::probe::gloss_scratch_size(n));
  for (std::size_t c = 0; c < 3; ++c)
    nook::probe::fit_gloss(gram.data(), moment.data()->data() + c, n, 3, amplitude.data()->data() + c,
                           scratch.data());
  std::vector<Vec3> gloss;
  for (const Channels& a : amplitude) gloss.push_back({float(a[0]), float(a[1]), float(a[2])});
  return gloss;
}

}  // namespace nook::bake::probe
