#include "bakers/raytrace/specular_visibility.h"

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/random.h"

namespace nook::bake {
namespace {

// Samples a visible microfacet normal. `view` and the result are in the frame of the surface.
Vec3 visible_normal(Vec3 view, float alpha, float u, float v) {
  const Vec3 stretched = normalised(Vec3{alpha * view.x, alpha * view.y, view.z});
  const float across2 = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 one =
      across2 > 0 ? Vec3{-stretched.y, stretched.x, 0} * (1 / std::sqrt(across2)) : Vec3{1, 0, 0};
  const Vec3 two = cross(stretched, one);
  const float radius = std::sqrt(u), angle = 6.2831853f * v, share = 0.5f * (1 + stretched.z);
  const float along_one = radius * std::cos(angle);
  const float along_two =
      (1 - share) * std::sqrt(std::max(1 - along_one * along_one, 0.0f)) + share * radius * std::sin(angle);
  const float up = std::sqrt(std::max(1 - along_one * along_one - along_two * along_two, 0.0f));
  const Vec3 hemisphere = along_one * one + along_two * two + up * stretched;
  return normalised(Vec3{alpha * hemisphere.x, alpha * hemisphere.y, std::max(hemisphere.z, 0.0f)});
}

// Smith's Lambda function for GGX.
float hidden_slopes(float cosine, float alpha) {
  const float tangent2 = (1 - cosine * cosine) / std::max(cosine * cosine, 1e-8f);
  return 0.5f * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

// Calls add(direction, weight, open) for each ray. The direction is in world space.
template <class Add>
void for_each_reflection(const RayScene& scene, const GlossyPoint& point, float roughness, std::uint32_t rays,
                         std::uint64_t seed, Add&& add) {
  const float alpha = roughness * roughness;
  Random random(seed);
  const Frame frame = turned_frame(point.normal, 1, 0);
  const Vec3 view{dot(point.to_viewer, frame.x), dot(point.to_viewer, frame.y),
                  std::max(dot(point.to_viewer, frame.z), 1e-3f)};
  const Vec3 origin = point.position + point.origin_offset * point.normal;
  const float towards_viewer = 1 + hidden_slopes(view.z, alpha);
  for (std::uint32_t i = 0; i < rays; ++i) {
    const float u = (float(i) + random.unit()) / float(rays), v = random.unit();
    const Vec3 normal = visible_normal(view, alpha, u, v);
    const Vec3 light = 2 * dot(view, normal) * normal - view;
    if (light.z <= 0) continue;
    const double weight = double(towards_viewer / (towards_viewer + hidden_slopes(light.z, alpha)));
    const Vec3 direction = to_world(frame, light);
    const float distance = scene.nearest(origin, direction).distance;
    const bool hidden = std::isfinite(distance) && distance <= point.radius;
    add(direction, weight, !hidden);
  }
}

}  // namespace

float trace_specular_visibility(const RayScene& scene, const GlossyPoint& point, float roughness,
                                std::uint32_t rays, std::uint64_t seed) {
  double open = 0, all = 0;
  for_each_reflection(scene, point, roughness, rays, seed, [&](Vec3, double weight, bool is_open) {
    all += weight;
    if (is_open) open += weight;
  });
  return all > 0 ? float(open / all) : 1;
}

GlossyLight trace_glossy_light(const RayScene& scene, const GlossyPoint& point, float roughness,
                               std::uint32_t rays, std::uint64_t seed, std::span<const Environment> maps) {
  GlossyLight light;
  double open = 0, all = 0;
  for_each_reflection(scene, point, roughness, rays, seed, [&](Vec3 direction, double weight, bool is_open) {
    all += weight;
    if (is_open) open += weight;
    for (std::size_t m = 0; m < maps.size(); ++m) {
      const Vec3 radiance = float(weight) * maps[m].radiance(direction);
      light.open[m] += radiance;
      if (is_open) light.seen[m] += radiance;
    }
  });
  if (!(all > 0)) return light;
  light.visible = float(open / all);
  for (std::size_t m = 0; m < maps.size(); ++m) {
    light.open[m] = light.open[m] * float(1 / all);
    light.seen[m] = light.seen[m] * float(1 / all);
  }
  return light;
}

}  // namespace nook::bake
