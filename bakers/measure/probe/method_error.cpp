#include "bakers/measure/probe/method_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "bakers/probe/map_bake.h"
#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::probe {
namespace {

using nook::probe::Constraint;
using nook::probe::Fit;
using nook::probe::FitMethod;
using nook::probe::FitSettings;

constexpr std::size_t few_samples = 1024, many_samples = 20000;
constexpr std::size_t seeding_share = 64;  // the short run of a seeded fit uses 1/64 of the samples

struct SeedSamples {
  Samples uniform, luminance;
};

// Fits a probe to the first `count` samples.
std::vector<Vec3> fit_samples(const ProbeMethod& method, const Samples& samples, std::size_t count) {
  FitSettings settings = method.fit;
  if (settings.growing_samples > 0) settings.growing_samples = float(count);
  Fit fit(method.basis, settings);
  std::size_t first = 0;
  if (method.seeded) {
    Fit short_run(method.basis, settings);
    first = count / seeding_share;
    add_samples(short_run, samples, 0, first);
    fit.seed(short_run);
  }
  add_samples(fit, samples, first, count - first);
  std::vector<Vec3> coefficients(method.basis.count);
  fit.read(coefficients);
  return coefficients;
}

SampledError measure(const ProbeMethod& method, const ExactFit& exact, const IrradianceTruth& truth,
                     const std::vector<SeedSamples>& seeds, Samples SeedSamples::*kind, std::size_t count) {
  std::vector<SampledError> of_seed(seeds.size());
  tbb::parallel_for(std::size_t(0), seeds.size(), [&](std::size_t s) {
    const std::vector<Vec3> b = fit_samples(method, seeds[s].*kind, count);
    const double ratio = exact.mean_ratio(b);
    of_seed[s] = {exact.excess(b), exact.distance(b), ratio, ratio, truth.error(method.basis, b).minimum};
  });
  SampledError all;
  all.irradiance_minimum = std::numeric_limits<double>::infinity();
  all.mean_worst = of_seed.front().mean_worst;
  for (const SampledError& e : of_seed) {
    all.excess_mse += e.excess_mse / double(seeds.size());
    all.distance += e.distance / double(seeds.size());
    all.mean_ratio += e.mean_ratio / double(seeds.size());
    if (std::abs(e.mean_ratio - 1) > std::abs(all.mean_worst - 1)) all.mean_worst = e.mean_ratio;
    all.irradiance_minimum = std::min(all.irradiance_minimum, e.irradiance_minimum);
  }
  return all;
}

// Draws a unit quaternion uniformly over all rotations (K. Shoemake 1992).
Basis rotated(Basis basis, Random& random) {
  const double share = random.unit_double(), turn = 2 * std::numbers::pi * random.unit_double(),
               other = 2 * std::numbers::pi * random.unit_double();
  const auto x = float(std::sqrt(1 - share) * std::sin(turn)),
             y = float(std::sqrt(1 - share) * std::cos(turn)), z = float(std::sqrt(share) * std::sin(other)),
             w = float(std::sqrt(share) * std::cos(other));
  const Vec3 v{x, y, z};
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    const Vec3 a = basis.axis[i], across = cross(v, a) * 2.0f;
    basis.axis[i] = normalised(a + across * w + cross(v, across));
  }
  return basis;
}

std::vector<double> rotated_errors(const ProbeMethod& method, const Samples& texels,
                                   const IrradianceTruth& truth, const ComparisonSettings& settings) {
  if (method.basis.kind != nook::probe::BasisKind::gaussians || method.basis.domain == Domain::hemisphere ||
      nook::probe::is_running(method.fit.method))
    return {};
  std::vector<double> errors(settings.rotations);
  tbb::parallel_for(std::size_t(0), errors.size(), [&](std::size_t r) {
    Random random(mix_bits(settings.seed) + r);
    MapBakeSettings bake;
    bake.basis = rotated(method.basis, random);
    bake.fit = method.fit;
    errors[r] = truth.error(bake.basis, bake_map(bake, texels)).rms / truth.mean();
  });
  return errors;
}

}  // namespace

std::vector<ProbeMethod> own_probe_methods(std::uint32_t lobes, const Region& region) {
  const Basis gaussians = nook::probe::vogel_basis(lobes, false, region.domain, region.up);
  FitSettings plain, bands;
  plain.method = bands.method = FitMethod::least_squares;
  plain.constraint = Constraint::none;
  bands.constraint = Constraint::bands;
  return {{"least_squares", gaussians, plain, false}, {"least_squares, bands", gaussians, bands, false}};
}

std::vector<MethodError> compare_methods(const Environment& map, const std::vector<ProbeMethod>& methods,
                                         const Region& region, const ComparisonSettings& settings,
                                         const std::function<bool(std::size_t, std::size_t)>& progress) {
  const IrradianceTruth truth(map, region);
  const LightSampler sampler(map, uniform_share);
  std::vector<SeedSamples> seeds(settings.seeds);
  tbb::parallel_for(std::size_t(0), seeds.size(), [&](std::size_t s) {
    const std::uint64_t seed = mix_bits(settings.seed) + s;
    seeds[s] = {uniform_samples(map, region, many_samples, seed),
                luminance_samples(map, sampler, region, many_samples, seed)};
  });
  const Samples texels = texel_samples(map, region, settings.seed);
  const Samples by_luminance = luminance_samples(map, sampler, region, settings.baked_samples, settings.seed);
  std::vector<MethodError> errors;
  std::optional<ExactFit> exact;
  for (const ProbeMethod& method : methods) {
    if (progress && !progress(errors.size(), methods.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring (%zu of %zu methods done)",
                    errors.size(), methods.size());
    if (!exact || !(exact->basis() == method.basis)) exact.emplace(map, method.basis);
    MapBakeSettings bake;
    bake.basis = method.basis;
    bake.fit = method.fit;
    bake.fit.growing_samples = 0;
    const std::vector<Vec3> b =
        bake_map(bake, nook::probe::is_running(method.fit.method) ? by_luminance : texels);
    const IrradianceTruth::Error irradiance = truth.error(method.basis, b);
    MethodError error;
    error.method = method;
    error.radiance_rms = exact->rms(b);
    error.irradiance_rms = irradiance.rms;
    error.irradiance_rms_fitted = truth.error(method.basis, b, IrradianceForm::fitted).rms;
    error.irradiance_rms_inner_product = truth.error(method.basis, b, IrradianceForm::inner_product).rms;
    error.mean_ratio = exact->mean_ratio(b);
    error.irradiance_minimum = irradiance.minimum;
    error.irradiance_mean = truth.mean();
    error.rotated = rotated_errors(method, texels, truth, settings);
    error.uniform_1024 = measure(method, *exact, truth, seeds, &SeedSamples::uniform, few_samples);
    error.uniform_20000 = measure(method, *exact, truth, seeds, &SeedSamples::uniform, many_samples);
    error.luminance_20000 = measure(method, *exact, truth, seeds, &SeedSamples::luminance, many_samples);
    errors.push_back(std::move(error));
  }
  if (progress) progress(methods.size(), methods.size());
  return errors;
}

}  // namespace nook::bake::probe
