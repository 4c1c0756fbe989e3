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
                                      const std::function<bool(std::size_t, std::size_t)>& progress) {
  truth.radius = request.radius;
  const TrainingScene scene = read_scene(request, truth.seed);
  const bake::RayScene rays(scene.soup);
  std::vector<Camera> cameras;
  for (const GivenCamera& c : request.cameras)
    cameras.push_back(look_at(c.eye, c.target, 0, c.fov, truth.width, truth.height));
  for (std::uint32_t i = 0; request.cameras.empty() && i < placed; ++i) {
    bake::Random random(bake::mix_bits(truth.seed) + i);
    cameras.push_back(place_camera(rays, scene, random, truth.width, truth.height));
  }
  std::vector<MeasuredView> views;
  for (const Camera& camera : cameras) {
    if (!progress(views.size(), cameras.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing");
    views.push_back(measure_view(rays, request.name, camera, truth));
  }
  progress(views.size(), cameras.size());
  return views;
}

}  // namespace nook::measure
