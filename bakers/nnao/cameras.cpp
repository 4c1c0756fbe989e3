#include "bakers/nnao/cameras.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

namespace nook::bake::nnao {
namespace {

Vec3 inside(const Box& box, Random& random) {
  const float x = random.between(box.low.x, box.high.x), y = random.between(box.low.y, box.high.y);
  return {x, y, random.between(box.low.z, box.high.z)};
}

// Rates a camera: the share of the screen that shows surfaces at 0.35 m to 9 m, minus 4 times the share that
// shows nearer surfaces.
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
  // Most attempts are good enough. If none is, the best one is used.
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

namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

struct Screen {
  std::uint32_t width, height;
  float aspect() const { return float(width) / float(height); }
};

Screen any_screen(Random& random, std::uint32_t width, std::uint32_t height) {
  const float kind = random.unit();
  if (kind < 0.55f) return {width, height};
  const float aspect = kind < 0.7f    ? 4.0f / 3
                       : kind < 0.82f ? 21.0f / 9
                       : kind < 0.91f ? 3.0f / 4
                                      : 9.0f / 16;
  const float pixels = float(width * height);
  const auto columns = std::uint32_t(std::lround(std::sqrt(pixels * aspect)));
  return {columns, std::uint32_t(pixels) / columns};
}

float any_field_of_view(Random& random, float aspect, float widest) {
  const float vertical = random.log_between(25 * degree, widest);
  const float limit = 2 * std::atan(std::tan(62.5f * degree) / aspect);
  return std::min(vertical, limit);
}

enum class Kind { inside, walker, grazing, close_up, afar, above };

Kind any_kind(Random& random) {
  const float share = random.unit();
  if (share < 0.30f) return Kind::inside;
  if (share < 0.50f) return Kind::walker;
  if (share < 0.67f) return Kind::grazing;
  if (share < 0.82f) return Kind::close_up;
  return share < 0.92f ? Kind::afar : Kind::above;
}

Vec3 point_in(const Box& box, Random& random) {
  const float x = random.between(box.low.x, box.high.x), y = random.between(box.low.y, box.high.y);
  return {x, y, random.between(box.low.z, box.high.z)};
}

struct Line {
  Vec3 eye, target;
  float nearest;  // metres; surfaces that are nearer block the view
  float widest = 100 * degree;
};

// Returns the eye and the target of one attempt, or nothing if the attempt fails.
std::optional<Line> any_line(Kind kind, const RayScene& rays, const TrainingScene& scene, Random& random) {
  const float size = scene.size;
  const Vec3 eye = point_in(scene.cameras, random), target = point_in(scene.subject, random);
  const float angle = random.between(0, 2 * std::numbers::pi_v<float>);
  switch (kind) {
    case Kind::inside:
      return Line{eye, target, 0.25f * size};
    case Kind::walker: {
      const float height = size * random.between(0.9f, 1.9f), pitch = random.between(-40, 8) * degree;
      const float ground = rays.nearest(eye, {0, -1, 0}).distance;
      if (!std::isfinite(ground)) return {};
      const Vec3 stand = eye + Vec3{0, height - ground, 0};
      const Vec3 ahead = normalised(Vec3{target.x - stand.x, 0, target.z - stand.z});
      return Line{stand, stand + std::cos(pitch) * ahead + Vec3{0, std::sin(pitch), 0}, 0.25f * size};
    }
    case Kind::grazing:
    case Kind::close_up: {
      const Vec3 ahead = normalised(target - eye);
      const RayHit hit = rays.nearest(eye, ahead);
      if (!std::isfinite(hit.distance)) return {};
      const Vec3 p = eye + hit.distance * ahead, n = hit.normal;
      if (kind == Kind::grazing) {
        const float away = size * random.log_between(0.04f, 0.5f);
        Vec3 u, v;
        axes_across(n, u, v);
        const Vec3 along = std::cos(angle) * u + std::sin(angle) * v;
        return Line{p + away * n, p + away * n + along - random.between(0.05f, 0.4f) * n, 0.3f * away};
      }
      const float away = size * random.log_between(0.12f, 0.8f);
      const Vec3 aside =
          random.between(0.2f, 1) * n - random.between(0.1f, 1) * ahead + 0.4f * any_direction(random);
      return Line{p + away * normalised(aside), p, 0.3f * away};
    }
    case Kind::afar: {
      Vec3 back = random.log_between(2.5f, 10) * (eye - target);
      back.y = std::max(back.y, 0.06f * length(back));
      return Line{target + back, target, 0.5f * size, 50 * degree};
    }
    default: {
      const float pitch = random.between(35, 75) * degree, away = size * random.log_between(2, 12);
      const Vec3 back{std::cos(pitch) * std::cos(angle), std::sin(pitch), std::cos(pitch) * std::sin(angle)};
      return Line{target + away * back, target, 0.5f * size};
    }
  }
}

// Rates a camera: 1 if surfaces fill at least 75 % of the screen and have the given share of edges and bends,
// otherwise less.
float worth(const RayScene& rays, const Camera& camera, float nearest, float relief_share) {
  constexpr int columns = 24, rows = 14;
  std::array<RayHit, columns * rows> hits;
  std::array<Vec3, columns * rows> position;
  int good = 0, near = 0, pairs = 0, bent = 0;
  for (int i = 0; i < columns * rows; ++i) {
    const auto at = std::size_t(i);
    const float px = (float(i % columns) + 0.5f) * float(camera.width) / columns;
    const float py = (float(i / columns) + 0.5f) * float(camera.height) / rows;
    const PixelRay ray = pixel_ray(camera, px, py);
    hits[at] = rays.nearest(ray.origin_ws, ray.direction_ws);
    position[at] = ray.origin_ws + hits[at].distance * ray.direction_ws;
    near += hits[at].distance < nearest;
    good += std::isfinite(hits[at].distance) && hits[at].distance >= nearest;
    for (const int back : {1, columns}) {
      if (i < back || (back == 1 && i % columns == 0)) continue;
      const auto other = std::size_t(i - back);
      if (!std::isfinite(hits[at].distance) || !std::isfinite(hits[other].distance)) continue;
      const float step = std::abs(dot(hits[at].normal, position[other] - position[at]));
      ++pairs;
      bent += dot(hits[at].normal, hits[other].normal) < 0.97f || step > 0.03f * hits[at].distance;
    }
  }
  const float relief = pairs > 0 ? float(bent) / float(pairs) : 0;
  const float full = float(good) / (columns * rows), blocked = float(near) / (columns * rows);
  return 0.6f * std::min(full, 0.75f) / 0.75f + 0.4f * std::min(relief / relief_share, 1.0f) - 4 * blocked;
}

}  // namespace

Camera place_training_camera(const RayScene& rays, const TrainingScene& scene, Random& random,
                             std::uint32_t width, std::uint32_t height) {
  const Screen screen = any_screen(random, width, height);
  const Kind kind = any_kind(random);
  const float relief_share = random.between(0.06f, 0.3f);
  Camera best;
  float best_worth = -10;
  // If 25 attempts find no good place for this kind, the remaining ones use the first kind.
  for (int attempt = 0; attempt < 40 && best_worth < 0.999f; ++attempt) {
    const Kind tried = attempt < 25 || best_worth > 0.75f ? kind : Kind::inside;
    const auto line = any_line(tried, rays, scene, random);
    const float roll = random.between(-0.15f, 0.15f);
    if (!line || std::abs(normalised(line->eye - line->target).y) > 0.99f) continue;
    const float fov = any_field_of_view(random, screen.aspect(), line->widest);
    const Camera camera = look_at(line->eye, line->target, roll, fov, screen.width, screen.height);
    const float camera_worth = worth(rays, camera, line->nearest, relief_share);
    if (camera_worth <= best_worth) continue;
    best = camera;
    best_worth = camera_worth;
  }
  if (best.width == 0) return place_camera(rays, scene, random, screen.width, screen.height);
  return best;
}

}  // namespace nook::bake::nnao
