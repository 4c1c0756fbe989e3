#include "bakers/measure/nnao/scene_views.h"

#include "bakers/import/static_scene.h"
#include "bakers/measure/nnao/thin_scene.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake::nnao;

TrainingScene read_scene(const SceneRequest& request, std::uint64_t seed) {
  if (request.file.empty()) return make_thin_scene(seed);
  bake::StaticScene scene =
      bake::import_static_scene(request.file, bake::SceneTextures::skip, request.linked);
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

}  // namespace nook::measure
