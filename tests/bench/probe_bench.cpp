// add_samples of the probe fits on one core, 12 lobes and RGB. The argument is the nook_isa;
// ratio_to_scalar is how many times as fast as that it is.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "sdk/src/probe/fit.h"

namespace {

using namespace nook;
using namespace nook::probe;

struct Samples {
  static constexpr std::size_t count = 4096;
  std::vector<float> directions, radiance;

  Samples() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const float z = 2 * uniform(random) - 1, azimuth = 6.2831853f * uniform(random),
                  r = std::sqrt(1 - z * z);
      directions.insert(directions.end(), {r * std::cos(azimuth), r * std::sin(azimuth), z});
      for (int c = 0; c < 3; ++c) radiance.push_back(2 * uniform(random));
    }
  }
};

// Of processor time, as the benchmark counts it.
double seconds_a_sample(const FitSettings& settings, const Samples& samples) {
  Fit fit(vogel_basis(12), settings);
  constexpr int passes = 50;
  const std::clock_t start = std::clock();
  for (int pass = 0; pass < passes; ++pass)
    fit.add_samples(samples.directions.data(), samples.radiance.data(), nullptr, Samples::count);
  return double(std::clock() - start) / CLOCKS_PER_SEC / (passes * double(Samples::count));
}

void add_samples(benchmark::State& state, FitMethod method, Step step) {
  const auto isa = static_cast<Isa>(state.range(0));
  const Samples samples;
  FitSettings settings;
  settings.method = method;
  settings.step = step;
  settings.isa = NOOK_ISA_SCALAR;
  const double scalar = seconds_a_sample(settings, samples);
  settings.isa = static_cast<nook_isa>(isa);
  Fit fit(vogel_basis(12), settings);
  const std::clock_t start = std::clock();
  for (auto _ : state)
    fit.add_samples(samples.directions.data(), samples.radiance.data(), nullptr, Samples::count);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const auto done = std::int64_t(state.iterations()) * std::int64_t(Samples::count);
  state.SetItemsProcessed(done);
  state.counters["ratio_to_scalar"] = scalar * double(done) / seconds;
}

void every_isa(benchmark::internal::Benchmark* all) {
  for (const Isa isa : all_isas)
    if (isa_available(isa)) all->Arg(static_cast<nook_isa>(isa));
}

}  // namespace

BENCHMARK_CAPTURE(add_samples, running_average, FitMethod::running_average, Step::fast)->Apply(every_isa);
BENCHMARK_CAPTURE(add_samples, running_average_plain, FitMethod::running_average, Step::plain)
    ->Apply(every_isa);
BENCHMARK_CAPTURE(add_samples, running_average_non_negative_plain, FitMethod::running_average_non_negative,
                  Step::plain)
    ->Apply(every_isa);
BENCHMARK_CAPTURE(add_samples, moments, FitMethod::moments, Step::fast)->Apply(every_isa);
BENCHMARK_CAPTURE(add_samples, least_squares, FitMethod::least_squares, Step::fast)->Apply(every_isa);
