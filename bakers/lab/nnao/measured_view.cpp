#include "bakers/lab/nnao/measured_view.h"

#include "bakers/import/static_scene.h"
#include "bakers/lab/nnao/built_in_scenes.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

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
    // Few rays are enough for tuning, because the noise of the reference increases the error of all
    // candidates by the same amount.
    settings.rays = 32;
    settings.radius = radii[(i + i / family_count) % 3];
    const Camera camera = place_camera(rays, scene, random, settings.width, settings.height);
    views.push_back(measure_view(rays, "training", camera, settings));
  }
  progress(count, count);
  return views;
}

namespace {

TrainingScene read_scene(const SceneRequest& request, std::uint64_t seed) {
  if (request.file.empty()) return make_thin_scene(seed);
  bake::StaticScene scene =
      bake::import_static_scene(request.file, bake::SceneTextures::skip, request.reading);
  return scene_to_look_at({std::move(scene.position), std::move(scene.triangle)});
}

}  // namespace

std::vector<MeasuredView> trace_views(const SceneRequest& request, TruthSettings truth, std::uint32_t placed,
                                      const std::filesystem::path& references,
                                      const std::function<bool(std::size_t, std::size_t)>& progress) {
  const TrainingScene scene = read_scene(request, truth.seed);
  const bake::RayScene rays(scene.soup);
  std::vector<Camera> cameras;
  for (const GivenCamera& c : request.cameras)
    cameras.push_back(look_at(c.eye, c.target, 0, c.fov, truth.width, truth.height));
  for (std::uint32_t i = 0; request.cameras.empty() && i < placed; ++i) {
    bake::Random random(bake::mix_bits(truth.seed) + i);
    cameras.push_back(place_camera(rays, scene, random, truth.width, truth.height));
  }
  const TruthStore store(references, scene.soup);
  std::vector<MeasuredView> views;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!progress(i, cameras.size())) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing");
    const GivenCamera given = request.cameras.empty() ? GivenCamera{} : request.cameras[i];
    truth.radius = given.radius > 0 ? given.radius : request.radius;
    views.push_back(measure_view(rays, request.name, cameras[i], truth, store));
    views.back().camera = given.name;
    if (!request.source.empty()) views.back().source = request.source;
  }
  progress(views.size(), cameras.size());
  return views;
}

}  // namespace nook::lab
