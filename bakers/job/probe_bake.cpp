#include "bakers/job/probe_bake.h"

#include "bakers/import/content_hash.h"
#include "bakers/probe/wall_fit.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr std::uint32_t passes_between_errors = 4;

}  // namespace

std::string content_hash(const Environment& map) {
  ContentHash hash;
  hash.add(std::string_view("nook environment 1"));
  hash.add(map.width());
  hash.add(map.height());
  hash.add_list(map.rgb());
  return hash.hex();
}

MapProbe bake_map_probe(const Environment& map, const probe::MapBakeSettings& settings,
                        const Progress& progress) {
  MapProbe baked;
  baked.probes.basis = settings.basis;
  const probe::Samples samples = probe::bake_samples(map, settings);
  const std::vector<Vec3> coefficients = probe::bake_map(settings, samples, progress);
  baked.probes.coefficients.assign(coefficients.begin(), coefficients.end());
  if (settings.basis.kind == nook::probe::BasisKind::gaussians) {
    const std::vector<Vec3> gloss = probe::map_gloss(map, settings.basis);
    baked.probes.gloss.assign(gloss.begin(), gloss.end());
  }
  baked.samples = samples.size();
  return baked;
}

double refine_grid(probe::GridBake& bake, const GridRefinement& refinement) {
  double error = 1;
  platform::Stopwatch since_preview;
  while (bake.passes() < refinement.max_passes && error > refinement.error) {
    if (!refinement.progress(bake.passes(), refinement.max_passes))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while path tracing");
    bake.pass();
    if (bake.passes() % passes_between_errors == 0) error = bake.error();
    if (refinement.preview_every_s > 0 && since_preview.seconds() >= refinement.preview_every_s) {
      error = bake.error();
      refinement.preview(error);
      since_preview = {};
    }
  }
  return bake.error();
}

void add_walls(nook::probe::Probes& probes, const LitScene& scene, const probe::TrainingSettings& settings,
               const Progress& progress) {
  const probe::TrainingPlaces places = probe::training_places(scene, probes.grid, settings, progress);
  probes.walls = probe::fit_walls(probes, places);
  probe::fit_to_surfaces(probes, places);
}

}  // namespace nook::bake
