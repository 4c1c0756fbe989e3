#include "bakers/material/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook::bake::material {
namespace {

constexpr float least_view_cosine = 0.05f;

Vec3 each_times(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

float fifth_power(float x) {
  return x * x * x * x * x;
}

}  // namespace

float ggx_width(float roughness) {
  const float kept = std::clamp(roughness, least_roughness, 1.0f);
  return kept * kept;
}

Vec3 microfacet_reflection(const Reflector& s, Vec3 normal, Vec3 view, Vec3 light) {
  const Vec3 half = normalised(view + light);
  const float n_l = std::max(dot(normal, light), 0.0f);
  const float n_v = std::max(dot(normal, view), least_view_cosine);
  const float n_h = std::max(dot(normal, half), 0.0f), v_h = std::max(dot(view, half), 0.0f);
  const float a2 = s.width * s.width;
  const float slope = n_h * n_h * (a2 - 1) + 1;
  const float density = a2 / (slope * slope);  // times pi
  const float masked =
      n_l * std::sqrt(n_v * n_v * (1 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1 - a2) + a2);
  const float gloss = masked > 0 ? density * 0.5f / masked : 0;
  const float grazing = fifth_power(1 - std::min(v_h, 1.0f));
  const Vec3 fresnel = s.reflectance + (Vec3{1, 1, 1} - s.reflectance) * grazing;
  return each_times(Vec3{1, 1, 1} - fresnel, s.diffuse) + fresnel * gloss;
}

}  // namespace nook::bake::material
