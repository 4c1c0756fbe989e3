// Cameras of the training set and their G-buffers.
#pragma once

#include <vector>

#include "bakers/nnao/scene_families.h"
#include "sdk/src/nnao/network_evaluate.h"

namespace nook::bake::nnao {

using nook::nnao::ScreenRays;
using nook::nnao::View;

struct Camera {
  Mat3x4 world_from_view;
  ScreenRays rays;
  std::uint32_t width = 0, height = 0;
};

// The view-space ray through a point of the screen; its depth is 1 for a length of 1.
struct PixelRay {
  Vec3 origin_ws, direction_ws;
};
PixelRay pixel_ray(const Camera& camera, float px, float py);

Camera look_at(Vec3 eye, Vec3 target, float roll, float vertical_fov, std::uint32_t width,
               std::uint32_t height);

// Returns a camera in the scene's camera box with a view of surfaces, neither inside a solid nor towards the
// sky.
Camera place_camera(const RayScene& rays, const TrainingScene& scene, Random& random, std::uint32_t width,
                    std::uint32_t height);

// A G-buffer by one primary ray for each pixel.
struct TracedView {
  Camera camera;
  std::vector<float> depth;  // -z, metres; infinite where the ray hits nothing
  std::vector<Vec3> normal;  // geometric, view space, facing the viewer

  View view() const { return {camera.width, camera.height, camera.rays, depth, normal}; }
};
TracedView trace_view(const RayScene& rays, const Camera& camera);

// Transforms to view space, without the translation.
Vec3 view_direction(const Camera& camera, Vec3 direction_ws);

}  // namespace nook::bake::nnao
