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

// The ray through a point of the screen, in world space. `direction_ws` is not normalised: its end is at a
// view depth of 1.
struct PixelRay {
  Vec3 origin_ws, direction_ws;
};
PixelRay pixel_ray(const Camera& camera, float px, float py);

Camera look_at(Vec3 eye, Vec3 target, float roll, float vertical_fov, std::uint32_t width,
               std::uint32_t height);

// Returns a camera in the scene's camera box that looks at surfaces. It avoids cameras inside a solid and
// cameras that look at the sky.
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

// Transforms a world-space direction to view space.
Vec3 view_direction(const Camera& camera, Vec3 direction_ws);

// Places the cameras of the training set where players and viewers would look from.

// Returns a camera of one of six kinds, each with the probability below. All lengths are multiplied by the
// scene's size:
//   0.30  in the scene's camera box
//   0.20  a walker, 0.9 to 1.9 m above the ground, looking at most 40 degrees down or 8 degrees up
//   0.17  grazing, 0.04 to 0.5 m away from a floor, a wall or an object, looking along its surface
//   0.15  a close-up, 0.12 to 0.8 m from a surface
//   0.10  from far away, 2.5 to 10 times the first kind's distance, field of view at most 50 degrees
//   0.08  from above, looking 35 to 75 degrees down, 2 to 12 m away
// The vertical field of view is log-uniform from 25 to 100 degrees, as long as the horizontal one stays below
// 125 degrees. 55 % of the screens have the given width and height. The others have about the same number of
// pixels, and aspect ratios such as 4:3, 21:9, 3:4 and 9:16. Most of the screen shows surfaces. If the scene
// has such a view, 6 to 30 % of the visible surfaces lie at edges or bends.
Camera place_training_camera(const RayScene& rays, const TrainingScene& scene, Random& random,
                             std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::nnao
