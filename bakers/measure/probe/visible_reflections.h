// Integrates the light that a GGX surface reflects to the eye, with a regular grid of visible normals (E.
// Heitz, Sampling the GGX Distribution of Visible Normals, 2018). Each reflected direction still needs two
// weights: the Fresnel term, and the height-correlated masking of the light (E. Heitz, Understanding the
// Masking-Shadowing Function, 2014, equation 99). Both are smooth, so grazing views are as exact as other
// views.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "sdk/src/probe/ggx_reflection.h"

namespace nook::measure {

struct ReflectedDirection {
  double x, y, z;  // along tangent, bitangent and normal
  double weight;   // contribution to the reflection without Fresnel; the weights sum to the albedo of a
                   // surface with reflectance 1
  double schlick;  // (1 - dot(view, micro normal))^5
};

// Returns up to steps^2 visible normals for a view with these components. Leaves out normals that reflect
// below the horizon.
inline std::vector<ReflectedDirection> visible_reflections(double alpha_x, double alpha_y, double x, double y,
                                                           double z, int steps) {
  std::vector<ReflectedDirection> all;
  const double size = std::hypot(alpha_x * x, alpha_y * y, z);
  const double vx = alpha_x * x / size, vy = alpha_y * y / size,
               vz = z / size;  // the view, scaled so that the slopes are isotropic
  const double flat = std::hypot(vx, vy);
  const double ux = flat > 1e-7 ? -vy / flat : 1, uy = flat > 1e-7 ? vx / flat : 0;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) {
      const double radius = std::sqrt((i + 0.5) / steps), turn = 2 * std::numbers::pi * (k + 0.5) / steps;
      const double a = radius * std::cos(turn), lifted = (1 + vz) / 2;
      const double b = (1 - lifted) * std::sqrt(1 - a * a) + lifted * radius * std::sin(turn);
      const double c = std::sqrt(std::max(1 - a * a - b * b, 0.0));
      // The disc's second axis is cross(v, u).
      double hx = alpha_x * (a * ux - b * vz * uy + c * vx), hy = alpha_y * (a * uy + b * vz * ux + c * vy);
      double hz = std::max(b * (vx * uy - vy * ux) + c * vz, 1e-12);
      const double length = std::hypot(hx, hy, hz);
      hx /= length, hy /= length, hz /= length;
      const double cosine = hx * x + hy * y + hz * z;
      const ReflectedDirection l{2 * cosine * hx - x, 2 * cosine * hy - y, 2 * cosine * hz - z, 0, 0};
      if (l.z <= 0) continue;
      const double hidden = std::hypot(l.z, alpha_x * l.x, alpha_y * l.y);
      const double masking = l.z * (z + size) / (z * hidden + l.z * size);
      all.push_back({l.x, l.y, l.z, masking / steps / steps, std::pow(1 - cosine, 5)});
    }
  return all;
}

inline std::vector<ReflectedDirection> visible_reflections(const probe::Surface& s, int steps) {
  const Vec3 bitangent = cross(s.normal, s.tangent);
  return visible_reflections(double(s.alpha_x), double(s.alpha_y), double(dot(s.view, s.tangent)),
                             double(dot(s.view, bitangent)), double(dot(s.view, s.normal)), steps);
}

}  // namespace nook::measure
