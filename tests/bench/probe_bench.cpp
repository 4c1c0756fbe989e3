// add_samples of the probe fits on one core, 12 lobes and RGB. The argument is the nook_isa;
// ratio_to_published is how many times as fast it is as the published running average with the same flags.
// add_samples_by_calls goes through the C function; its second argument is the number of samples of a call.
#include <benchmark/benchmark.h>
#include <nook/nook_probe.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "sdk/src/probe/fit.h"
#include "tests/bench/published_average.h"

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

bench::PublishedAverage published_average(Isa isa) {
  if (isa == Isa::avx512) return bench::published_avx512::published_average;
  if (isa == Isa::avx2) return bench::published_avx2::published_average;
  return bench::published_sse2::published_average;
}

bench::PublishedFit published_fit(const Basis& basis) {
  bench::PublishedFit fit;
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    const float sharpness = basis.sharpness[i], square = (1 - std::exp(-4 * sharpness)) / (4 * sharpness);
    fit.lobes.push_back(
        {{basis.axis[i].x, basis.axis[i].y, basis.axis[i].z}, sharpness, {0, 0, 0}, 0, 0, square});
  }
  return fit;
}

// Of processor time, as the benchmark counts it; the best of several, as a busy machine has bad ones.
double published_seconds(Isa isa, const Samples& samples) {
  bench::PublishedFit fit = published_fit(vogel_basis(12));
  const bench::PublishedAverage average = published_average(isa);
  double best = 1;
  for (int trial = 0; trial < 5; ++trial) {
    constexpr int passes = 50;
    const std::clock_t start = std::clock();
    for (int pass = 0; pass < passes; ++pass)
      average(fit, samples.directions.data(), samples.radiance.data(), Samples::count);
    best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC / (passes * double(Samples::count)));
  }
  benchmark::DoNotOptimize(fit.lobes.data());
  return best;
}

void add_samples(benchmark::State& state, FitMethod method, Step step) {
  const auto isa = static_cast<Isa>(state.range(0));
  const Samples samples;
  FitSettings settings;
  settings.method = method;
  settings.step = step;
  const double published = published_seconds(isa, samples);
  settings.isa = static_cast<nook_isa>(isa);
  Fit fit(vogel_basis(12), settings);
  const std::clock_t start = std::clock();
  for (auto _ : state)
    fit.add_samples(samples.directions.data(), samples.radiance.data(), nullptr, Samples::count);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const auto done = std::int64_t(state.iterations()) * std::int64_t(Samples::count);
  state.SetItemsProcessed(done);
  state.counters["ratio_to_published"] = published * double(done) / seconds;
}

void add_samples_by_calls(benchmark::State& state) {
  const Samples samples;
  const double published = published_seconds(static_cast<Isa>(state.range(0)), samples);
  nook_context_desc context_desc;
  nook_context_desc_init(&context_desc);
  context_desc.isa = static_cast<nook_isa>(state.range(0));
  nook_context context = nullptr;
  nook_probe_fit_desc desc;
  nook_probe_fit_desc_init(&desc);
  desc.lobe_count = 12;
  nook_probe_fit fit = nullptr;
  if (nook_context_create(&context_desc, &context) != NOOK_OK ||
      nook_probe_fit_create(context, &desc, &fit) != NOOK_OK)
    return state.SkipWithError(nook_last_message());
  const auto step = static_cast<std::size_t>(state.range(1));
  const std::clock_t start = std::clock();
  for (auto _ : state)
    for (std::size_t i = 0; i < Samples::count; i += step)
      nook_probe_fit_add_samples(fit, samples.directions.data() + 3 * i, samples.radiance.data() + 3 * i,
                                 nullptr, step);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const auto done = std::int64_t(state.iterations()) * std::int64_t(Samples::count);
  state.SetItemsProcessed(done);
  state.counters["ratio_to_published"] = published * double(done) / seconds;
  nook_probe_fit_destroy(&fit);
  nook_context_destroy(&context);
}

void every_isa_and_call(benchmark::internal::Benchmark* all) {
  for (const Isa isa : all_isas)
    if (isa_available(isa))
      for (const std::int64_t samples : {1, 4, 16, 64, 4096})
        all->Args({static_cast<nook_isa>(isa), samples});
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
BENCHMARK(add_samples_by_calls)->Apply(every_isa_and_call);
