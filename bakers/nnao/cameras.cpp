#include "bakers/nnao/cameras.h"

#include <algorithm>

namespace nook::bake::nnao {
namespace {

Vec3 inside(const Box& box, Random& random) {
  const float x = random.between(box.low.x, box.high.x), y = random.between(box.low.y, box.high.y);
  return {x, y, random.between(box.low.z, box.high.z)};
}

// Returns the share of the screen with a surface between 0.35 m and 9 m.
float worth(const RayScene& rays, Camera camera) {
  constexpr int columns = 24, rows = 14;
  int good = 0, near = 0;
  for (int i = 0; i < columns * rows; ++i) {
    const float px = (float(i % columns) + 0.5f) * float(camera.width) / columns;
    const float py = (float(i / columns) + 0.5f) * float(camera.height) / rows;
    const PixelRay ray = pixel_ray(camera, px, py);
    const float depth = rays.nearest(ray.origin_ws, ray.direction_ws).distance;
    near += depth < 0.35f;
    good += depth >= 0.35f && depth < 9;
  }
  return float(good - 4 * near) / (columns * rows);
}

}  // namespace

PixelRay pixel_ray(const Camera& camera, float px, float py) {
  const Vec3 at_1 = nook::nnao::view_position(camera.rays, px, py, 1);
  if (camera.rays.orthographic)
    return {transform_point(camera.world_from_view, {at_1.x, at_1.y, 0}),
            transform_vector(camera.world_from_view, {0, 0, -1})};
  return {transform_point(camera.world_from_view, {}), transform_vector(camera.world_from_view, at_1)};
}

Camera look_at(Vec3 eye, Vec3 target, float roll, float vertical_fov, std::uint32_t width,
               std::uint32_t height) {
  const Vec3 back = normalised(eye - target);
  const Vec3 level = normalised(cross({0, 1, 0}, back)), upright = cross(back, level);
  const Vec3 right = std::cos(roll) * level + std::sin(roll) * upright, up = cross(back, right);
  const float focal = 1 / std::tan(0.5f * vertical_fov);
  const float projection[16] = {
      focal * float(height) / float(width), 0, 0, 0, 0, focal, 0, 0, 0, 0, -1, -1, 0, 0, 0, 0};
  return {{{right.x, up.x, back.x, eye.x, right.y, up.y, back.y, eye.y, right.z, up.z, back.z, eye.z}},
          nook::nnao::screen_rays(projection, width, height),
          width,
          height};
}

Camera place_camera(const RayScene& rays, const TrainingScene& scene, Random& random, std::uint32_t width,
                    std::uint32_t height) {
  Camera best;
  float best_worth = -10;
  // Most places pass. If none does, the best of the attempts is taken.
  for (int attempt = 0; attempt < 24 && best_worth < 0.85f; ++attempt) {
    const Vec3 eye = inside(scene.cameras, random), target = inside(scene.subject, random);
    const float roll = random.between(-0.15f, 0.15f), fov = random.between(0.6f, 1.4f);
    const Camera camera = look_at(eye, target, roll, fov, width, height);
    const float camera_worth = worth(rays, camera);
    if (camera_worth <= best_worth) continue;
    best = camera;
    best_worth = camera_worth;
  }
  return best;
}

Vec3 view_direction(const Camera& camera, Vec3 d) {
  const float* m = camera.world_from_view.m;
  return {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
          m[2] * d.x + m[6] * d.y + m[10] * d.z};
}

TracedView trace_view(const RayScene& rays, const Camera& camera) {
  TracedView traced{camera, {}, {}};
  const std::size_t pixels = std::size_t(camera.width) * camera.height;
  traced.depth.reserve(pixels);
  traced.normal.reserve(pixels);
  const FlushDenormals flush;
  for (std::uint32_t y = 0; y < camera.height; ++y)
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const PixelRay ray = pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
      const RayHit hit = rays.nearest(ray.origin_ws, ray.direction_ws);
      traced.depth.push_back(hit.distance);
      traced.normal.push_back(view_direction(camera, hit.normal));
    }
  return traced;
}

}  // namespace nook::bake::nnao
