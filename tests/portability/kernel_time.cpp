// Times the kernels of every instruction set that this processor runs: one body alone, with a neighbour and
// the ground, under a light, and a probe fit. Each number is the fastest of many turns, since other processes
// can only add to it.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sdk/src/core/isa.h"
#include "tests/portability/kernel_body.h"

namespace {

using namespace nook;
using namespace nook::portability;

constexpr double seconds_a_row = 0.4;

template <class Work>
double fastest_us(Work&& work) {
  using Clock = std::chrono::steady_clock;
  double best = 1e9, whole = 0;
  // Clocks of browsers and node step by up to 0.1 ms: a turn is at least 2 ms long.
  int repeats = 1;
  while (whole < seconds_a_row) {
    const auto start = Clock::now();
    for (int i = 0; i < repeats; ++i) work();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds < 0.002) {
      repeats *= 2;
      continue;
    }
    best = std::min(best, seconds / repeats);
    whole += seconds;
  }
  return 1e6 * best;
}

void time(Isa isa) {
  const ShadowKernels& kernels = *shadow_kernels(isa);
  const probe::FitKernels& fits = *probe::fit_kernels(isa);
  Body body(1);
  ProbeFit fit(1);
  body.pose(kernels);
  const double pose = fastest_us([&] { body.pose(kernels); });
  const double shadow = fastest_us([&] { body.shadow(kernels, {}); });
  const double casters = fastest_us([&] { body.casters(kernels); });
  const double blend = fastest_us([&] { body.blend(kernels); });
  const double light = fastest_us([&] { body.light(kernels, {}); });
  const double sums = fastest_us([&] { fit.sums(fits); });
  std::printf("%-8s %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f\n", isa_name(isa), pose, shadow, casters, blend,
              pose + shadow + casters + blend, light, sums);
}

}  // namespace

int main() {
  std::printf("microseconds: %u spheres, %u key points, %u vertices; %u samples, %u lobes\n", Body::spheres,
              Body::key_points, Body::vertices, ProbeFit::samples, ProbeFit::lobes);
  std::printf("%-8s %9s %9s %9s %9s %9s %9s %9s\n", "set", "pose", "shadow", "casters", "blend", "update",
              "light", "fit");
  for (const Isa isa : all_isas)
    if (isa_available(isa)) time(isa);
}
