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

// The cameras of the training set, which stand where players and viewers do.

// Returns a camera of one of six kinds. Lengths are multiples of the scene's size:
//   0.30  in the scene's camera box
//   0.20  a walker, 0.9 to 1.9 m above the ground, whose view falls by 40 degrees or rises by 8 at most
//   0.17  grazing, 0.04 to 0.5 m above a floor, a wall or a thing, along it
//   0.15  a close-up from 0.12 to 0.8 m
//   0.10  from afar, 2.5 to 10 times the distance of the first kind, through a long lens
//   0.08  from above, by 35 to 75 degrees, 2 to 12 m away
// The vertical field of view has a uniform logarithm from 25 to 100 degrees, if the horizontal one is below
// 125. Of the screens 55 % have the sides that are given; the others have as many pixels, with sides as 4:3,
// 21:9, 3:4 and 9:16. Most of the screen shows surfaces, of which 6 to 30 % lie at edges or bends where such
// a place is found.
Camera place_training_camera(const RayScene& rays, const TrainingScene& scene, Random& random,
                             std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::nnao
