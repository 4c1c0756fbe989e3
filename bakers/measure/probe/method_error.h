// Measures several ways to fit a probe to one map.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bakers/measure/probe/fit_error.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/fit.h"

namespace nook::bake::probe {

// A basis and the way in which it is fitted. If `seeded` is true, the fit starts from the result of a short
// fit with 1/64 of the samples.
struct ProbeMethod {
  std::string name;
  Basis basis;
  nook::probe::FitSettings fit;
  bool seeded = false;

  std::size_t floats() const { return 3 * std::size_t(basis.count); }
};

// Returns two methods. The first is the default fit of a bake. The second is the same fit without the
// constraint on bands, and is called "least_squares". Ratios in reports are relative to "least_squares".
std::vector<ProbeMethod> own_probe_methods(std::uint32_t lobes, const Region& region);

struct ComparisonSettings {
  std::uint32_t seeds = 20;
  std::uint32_t baked_samples = 1u << 20;  // number of samples, distributed by luminance, for methods that
                                           // fit a running average to the whole map
  std::uint32_t rotations = 0;  // number of random rotations of the lobes' axes; used only by methods that
                                // solve the fit on the sphere
  std::uint64_t seed = 1;
};

// Statistics over all seeds of the error after n independent samples. The error is measured for samples with
// uniform directions, and for samples that are distributed by luminance.
struct SampledError {
  double excess_mse = 0;          // mean of ExactFit::excess
  double distance = 0;            // mean of ExactFit::distance
  double mean_ratio = 0;          // mean of ExactFit::mean_ratio
  double mean_worst = 0;          // the value of ExactFit::mean_ratio that is farthest from 1
  double irradiance_minimum = 0;  // the lowest value of IrradianceTruth::Error::minimum
};

struct MethodError {
  ProbeMethod method;
  // Errors of a fit to the whole map. The irradiance is computed in three ways: by bands, by Hill's fit and
  // by the inner product. The three results differ only for lobes.
  double radiance_rms = 0, irradiance_rms = 0, irradiance_rms_fitted = 0, irradiance_rms_inner_product = 0;
  double mean_ratio = 0, irradiance_minimum = 0;
  double irradiance_mean = 0;  // luminance of the mean irradiance of the map
  // irradiance_rms / irradiance_mean for the same lobes with rotated axes, one value per rotation. Empty for
  // other bases, and if no rotations were requested.
  std::vector<double> rotated;
  SampledError uniform_1024, uniform_20000, luminance_20000;
};

// `progress` counts methods. Throws Failure(NOOK_ERROR_CANCELLED) when `progress` returns false.
std::vector<MethodError> compare_methods(
    const Environment& map, const std::vector<ProbeMethod>& methods, const Region& region,
    const ComparisonSettings& settings,
    const std::function<bool(std::size_t done, std::size_t total)>& progress = {});

}  // namespace nook::bake::probe
