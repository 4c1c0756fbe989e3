// Measures ways to fit a probe on one map.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bakers/measure/probe/fit_error.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/fit.h"

namespace nook::bake::probe {

// A basis and how it is fitted. If `seeded` is true, the fit starts from a short run with 1/64 of the
// samples.
struct ProbeMethod {
  std::string name;
  Basis basis;
  nook::probe::FitSettings fit;
  bool seeded = false;

  std::size_t floats() const { return 3 * std::size_t(basis.count); }
};

// Returns the default fit of a bake, and the same fit without the constraint on bands, called
// "least_squares". Ratios in rows are relative to "least_squares".
std::vector<ProbeMethod> own_probe_methods(std::uint32_t lobes, const Region& region);

struct ComparisonSettings {
  std::uint32_t seeds = 20;
  std::uint32_t baked_samples = 1u << 20;  // samples by luminance for the bake of the whole map, for running
                                           // averages
  std::uint32_t rotations =
      0;  // uniform random rotations of the lobes' axes; only for solved fits on the sphere
  std::uint64_t seed = 1;
};

// The error after n independent samples, over all seeds. One set of samples has uniform directions, the other
// is distributed by luminance.
struct SampledError {
  double excess_mse = 0;          // mean of ExactFit::excess
  double distance = 0;            // mean of ExactFit::distance
  double mean_ratio = 0;          // mean of ExactFit::mean_ratio
  double mean_worst = 0;          // the mean_ratio farthest from 1
  double irradiance_minimum = 0;  // the lowest of IrradianceTruth::Error::minimum
};

struct MethodError {
  ProbeMethod method;
  // Errors for a bake of the whole map. Irradiance is computed by bands, by Hill's fit and by the inner
  // product. The three differ only for lobes.
  double radiance_rms = 0, irradiance_rms = 0, irradiance_rms_fitted = 0, irradiance_rms_inner_product = 0;
  double mean_ratio = 0, irradiance_minimum = 0;
  double irradiance_mean = 0;  // luminance, from the map
  // irradiance_rms divided by irradiance_mean, for the same lobes with rotated axes. Empty for other bases,
  // and if no rotations were asked for.
  std::vector<double> rotated;
  SampledError uniform_1024, uniform_20000, luminance_20000;
};

// `progress` counts methods. Throws Failure(NOOK_ERROR_CANCELLED) when `progress` returns false.
std::vector<MethodError> compare_methods(
    const Environment& map, const std::vector<ProbeMethod>& methods, const Region& region,
    const ComparisonSettings& settings,
    const std::function<bool(std::size_t done, std::size_t total)>& progress = {});

}  // namespace nook::bake::probe
