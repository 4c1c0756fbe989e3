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

// A G-buffer with one primary ray per pixel.
struct TracedView {
  Camera camera;
  std::vector<float> depth;  // -z, metres; infinite where the ray hits nothing
  std::vector<Vec3> normal;  // geometric, view space, facing the viewer

  View view() const { return {camera.width, camera.height, camera.rays, depth, normal}; }
};
TracedView trace_view(const RayScene& rays, const Camera& camera);

// Transforms to view space, without the translation.
Vec3 view_direction(const Camera& camera, Vec3 direction_ws);

// Places the cameras of the training set where players and viewers stand.

// Returns a camera of one of six kinds. Lengths are multiples of the scene's size:
//   0.30  in the scene's camera box
//   0.20  a walker, 0.9 to 1.9 m above the ground, whose view falls by 40 degrees or rises by 8 at most
//   0.17  grazing, 0.04 to 0.5 m above a floor, a wall or a thing, along it
//   0.15  a close-up from 0.12 to 0.8 m
//   0.10  from afar, 2.5 to 10 times the distance of the first kind, through a long lens
//   0.08  from above, by 35 to 75 degrees, 2 to 12 m away
// The vertical field of view has a uniform logarithm from 25 to 100 degrees, if the horizontal one is below
// 125. 55 % of the screens have the given sides. The others have as many pixels, with sides like 4:3, 21:9,
// 3:4 and 9:16. Most of the screen shows surfaces. If there is such a place, 6 to 30 % of them lie at edges
// or bends.
Camera place_training_camera(const RayScene& rays, const TrainingScene& scene, Random& random,
                             std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::nnao
