#include "bakers/measure/probe/comparison.h"

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
using nook::probe::Denominator;
using nook::probe::Fit;
using nook::probe::FitMethod;
using nook::probe::FitSettings;
using nook::probe::Step;

constexpr std::size_t few_samples = 1024, many_samples = 20000;
constexpr std::size_t seeding_share = 64;  // of the samples that go to the short run of a seeded fit

FitSettings settings_of(FitMethod method, Constraint constraint = Constraint::none) {
  FitSettings settings;
  settings.method = method;
  settings.constraint = constraint;
  return settings;
}

struct SeedSamples {
  Samples uniform, luminance;
};

// The fit of the first `count` samples.
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

// Uniform over all rotations: a unit quaternion (K. Shoemake 1992).
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

std::vector<ProbeMethod> probe_methods(std::uint32_t lobes, const Region& region) {
  const Basis gaussians = nook::probe::vogel_basis(lobes, false, region.domain, region.up);
  const Basis with_ambient = nook::probe::vogel_basis(lobes, true, region.domain, region.up);
  std::vector<ProbeMethod> methods;
  const auto add = [&](const char* name, const Basis& basis, const FitSettings& fit) {
    methods.push_back({name, basis, fit, false});
  };
  const FitSettings running = settings_of(FitMethod::running_average);
  add("naive", gaussians, settings_of(FitMethod::naive));
  add("running_average", gaussians, running);
  FitSettings variant = running;
  variant.growing_samples = 1;  // the number of samples takes its place
  add("running_average, growing weights", gaussians, variant);
  variant = running;
  variant.step = Step::plain;
  add("running_average, plain step", gaussians, variant);
  add("running_average, plain step, seeded", gaussians, variant);
  methods.back().seeded = true;
  variant.denominator = Denominator::precomputed;
  add("running_average, plain step, precomputed", gaussians, variant);
  add("running_average_original", gaussians, settings_of(FitMethod::running_average_original));
  add("running_average_non_negative", gaussians, settings_of(FitMethod::running_average_non_negative));
  add("moments", gaussians, settings_of(FitMethod::moments));
  add("least_squares", gaussians, settings_of(FitMethod::least_squares));
  add("non_negative_least_squares", gaussians, settings_of(FitMethod::non_negative_least_squares));
  constexpr std::pair<const char*, FitMethod> with_bands[] = {
      {"running_average, bands", FitMethod::running_average},
      {"running_average_non_negative, bands", FitMethod::running_average_non_negative},
      {"moments, bands", FitMethod::moments},
      {"least_squares, bands", FitMethod::least_squares},
      {"non_negative_least_squares, bands", FitMethod::non_negative_least_squares}};
  for (const auto& [name, method] : with_bands) add(name, gaussians, settings_of(method, Constraint::bands));
  if (region.domain == Domain::hemisphere) return methods;
  add("running_average, ambient", with_ambient, running);
  add("least_squares, ambient", with_ambient, settings_of(FitMethod::least_squares));
  add("non_negative_least_squares, ambient", with_ambient,
      settings_of(FitMethod::non_negative_least_squares));
  add("least_squares, ambient, bands", with_ambient,
      settings_of(FitMethod::least_squares, Constraint::bands));
  add("sh_l1", nook::probe::harmonic_basis(1), settings_of(FitMethod::least_squares));
  add("sh_l2", nook::probe::harmonic_basis(2), settings_of(FitMethod::least_squares));
  add("ambient_dice", nook::probe::dice_basis(), settings_of(FitMethod::least_squares));
  return methods;
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
