// The gain of block coordinate descent from the linear layer cached as A and B (Le et al. 2019, slides 55 to
// 57): one evaluation of the error and its gradient over many poses, cached and summed directly over
// vertices, in turns on the same data.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "bakers/character/block_descent.h"
#include "bakers/character/rotation.h"
#include "tests/bakers/character/direct_objective.h"

namespace {

using namespace nook;
using namespace nook::bake;

constexpr std::size_t bones = 60, spheres = 130, key_points = 500, entries = 7, poses = 64;

struct Problem {
  FitState state;
  TrainingSet set;

  explicit Problem(std::size_t vertices) {
    std::mt19937 bits(1);
    const auto uniform = [&](float low, float high) {
      return low + (high - low) * float(bits() >> 8) * 0x1p-24f;
    };
    LayerStructure& structure = state.structure;
    structure.kernel = {KernelForm::paper, 2.0f};
    for (std::size_t h = 0; h < spheres; ++h) structure.sphere_bone.push_back(std::uint16_t(bits() % bones));
    for (std::size_t k = 0; k < key_points; ++k)
      structure.key_point_bone.push_back({std::uint16_t(bits() % bones), 0, 0, 0});
    state.parameters.resize(structure.parameter_count());
    for (std::size_t h = 0; h < spheres; ++h) {
      float* q = &state.parameters[structure.sphere_offset(h)];
      for (int i = 0; i < 3; ++i) q[i] = uniform(-0.5f, 0.5f);
      q[3] = uniform(-4, -2);
    }
    for (std::size_t k = 0; k < key_points; ++k) {
      float* q = &state.parameters[structure.key_point_offset(k)];
      for (int i = 0; i < 6; ++i) q[i] = uniform(-0.5f, 0.5f);
      q[6] = 1;
    }
    state.linear.entries = entries;
    for (std::size_t i = 0; i < vertices * entries; ++i) {
      state.linear.key_point.push_back(std::uint16_t(bits() % key_points));
      state.linear.alpha.push_back(uniform(0, 0.3f));
    }
    state.linear.bias.assign(vertices, 0.05f);
    set.vertex_weight.assign(vertices, 1.0f);
    set.targets.vertex_count = vertices;
    for (std::size_t i = 0; i < vertices * poses; ++i) set.targets.value.push_back(std::uint16_t(bits()));
    for (std::size_t p = 0; p < poses; ++p) {
      Pose& pose = set.poses.emplace_back();
      for (std::size_t b = 0; b < bones; ++b)
        pose.push_back(rotation_about({}, {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}));
    }
  }
};

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void cached_against_direct(benchmark::State& run) {
  const Problem problem(static_cast<std::size_t>(run.range(0)));
  std::vector<double> gradient;
  double cached = 1e9, direct = 1e9, layer = 1e9, making = 1e9;
  for (auto _ : run) {
    CachedObjective cache;
    making = std::min(making, seconds_of([&] { cache = cache_linear_layer(problem.state, problem.set); }));
    cached =
        std::min(cached, seconds_of([&] { evaluate_cached(problem.state, problem.set, cache, &gradient); }));
    direct = std::min(
        direct, seconds_of([&] { bake::test::evaluate_direct(problem.state, problem.set, &gradient); }));
    // Both need the shadows of all poses, and about twice that for the way back.
    layer = std::min(layer, seconds_of([&] {
                       benchmark::DoNotOptimize(shadows_of(problem.state, problem.set.poses).data());
                     }));
  }
  run.counters["ms_cached"] = cached * 1e3;
  run.counters["ms_direct"] = direct * 1e3;
  run.counters["ms_making_the_cache"] = making * 1e3;
  run.counters["ms_shadows_forward"] = layer * 1e3;
  run.counters["gain"] = direct / cached;
}

// Welded vertices of the bodies in the tables, and of a hero of a film.
BENCHMARK(cached_against_direct)
    ->Arg(4400)
    ->Arg(7400)
    ->Arg(100000)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
