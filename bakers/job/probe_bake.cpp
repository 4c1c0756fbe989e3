#include "bakers/job/probe_bake.h"

#include <chrono>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr std::uint32_t passes_between_errors = 4;

}  // namespace

MapProbe bake_map_probe(const Environment& map, const probe::MapBakeSettings& settings,
                        const Progress& progress) {
  MapProbe baked;
  baked.probes.basis = settings.basis;
  const probe::Samples samples = probe::bake_samples(map, settings);
  const std::vector<Vec3> coefficients = probe::bake_map(settings, samples, progress);
  baked.probes.coefficients.assign(coefficients.begin(), coefficients.end());
  baked.samples = samples.size();
  return baked;
}

double refine_grid(probe::GridBake& bake, const GridRefinement& refinement) {
  using Clock = std::chrono::steady_clock;
  double error = 1;
  auto previewed = Clock::now();
  while (bake.passes() < refinement.max_passes && error > refinement.error) {
    if (!refinement.progress(bake.passes(), refinement.max_passes))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while path tracing");
    bake.pass();
    if (bake.passes() % passes_between_errors == 0) error = bake.error();
    const std::chrono::duration<double> since_preview = Clock::now() - previewed;
    if (refinement.preview_every_s > 0 && since_preview.count() >= refinement.preview_every_s) {
      error = bake.error();
      refinement.preview(error);
      previewed = Clock::now();
    }
  }
  return bake.error();
}

}  // namespace nook::bake
