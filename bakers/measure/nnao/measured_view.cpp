#include "bakers/measure/nnao/measured_view.h"

#include "sdk/src/core/failure.h"

namespace nook::measure {

using namespace bake::nnao;

MeasuredView measure_view(const bake::RayScene& rays, const std::string& scene, const Camera& camera,
                          const TruthSettings& settings, const TruthStore& store) {
  MeasuredView measured;
  measured.scene = measured.source = scene;
  measured.radius = settings.radius;
  measured.view = trace_view(rays, camera);
  measured.slid = trace_view(rays, slid_by_one_pixel(camera));
  Truth truth = store.read_or_trace(camera, settings, [&]() -> Truth {
    return {trace_truth(rays, measured.view, settings.radius, settings.rays, settings.seed),
            truth_noise(rays, measured.view, settings.radius, settings.rays, settings.seed)};
  });
  measured.truth = std::move(truth.ao);
  measured.noise = truth.noise;
  if (settings.bent_stride > 0)
    measured.bent = trace_bent_truth(rays, measured.view, settings.radius, settings.rays, settings.seed,
                                     settings.bent_stride);
  measured.path = trace_path(rays, measured.view, settings.path);
  return measured;
}

std::vector<MeasuredView> tuning_views(std::uint64_t seed,
                                       const std::function<bool(std::size_t, std::size_t)>& progress) {
  constexpr float radii[] = {0.25f, 0.5f, 1.0f};
  constexpr std::uint32_t count = 24;
  std::vector<MeasuredView> views;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!progress(i, count)) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing");
    const TrainingScene scene = make_scene(seed, i);
    const bake::RayScene rays(scene.soup);
    bake::Random random(seed + i);
    TruthSettings settings;
    settings.width = 320;
    settings.height = 180;
    // Their noise adds the same to the error of every tuning.
    settings.rays = 32;
    settings.radius = radii[(i + i / family_count) % 3];
    const Camera camera = place_camera(rays, scene, random, settings.width, settings.height);
    views.push_back(measure_view(rays, "training", camera, settings));
  }
  progress(count, count);
  return views;
}

}  // namespace nook::measure
