// The kernels' work in double precision, straight from the formulas, and random data to feed both.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "sdk/src/character/shadow_kernels.h"

namespace nook::test {

struct Spheres {
  std::vector<float> x, y, z, inverse_radius, weight;

  void add(Vec3 centre, float radius, float caster_weight = 1) {
    x.push_back(centre.x);
    y.push_back(centre.y);
    z.push_back(centre.z);
    inverse_radius.push_back(inverse_sphere_radius(radius));
    weight.push_back(caster_weight);
  }
  SphereSoa view() const {
    return {x.data(),      y.data(),
            z.data(),      inverse_radius.data(),
            weight.data(), static_cast<std::uint32_t>(x.size())};
  }
};

// Always whole groups; padding is zero.
struct Points {
  std::vector<float> number[6];
  std::uint32_t count = 0;

  void add(Vec3 position, Vec3 normal) {
    if (count % key_point_group == 0)
      for (std::vector<float>& n : number) n.resize(n.size() + key_point_group, 0.0f);
    const float value[6] = {position.x, position.y, position.z, normal.x, normal.y, normal.z};
    for (int a = 0; a < 6; ++a) number[a][count] = value[a];
    ++count;
  }
  std::uint32_t padded() const { return padded_key_points(count); }
  KeyPointSoa view() const {
    return {number[0].data(), number[1].data(), number[2].data(), number[3].data(),
            number[4].data(), number[5].data(), padded()};
  }
};

inline Vec3 random_vector(std::mt19937& random, float extent) {
  std::uniform_real_distribution<float> along(-extent, extent);
  const float x = along(random), y = along(random), z = along(random);
  return {x, y, z};
}
inline Vec3 random_direction(std::mt19937& random) {
  for (;;) {
    const Vec3 v = random_vector(random, 1);
    if (dot(v, v) > 0.01f && dot(v, v) < 1) return normalised(v);
  }
}

// A body's worth of spheres and key points in a box of two metres.
inline Spheres random_spheres(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> radius(0.01f, 0.2f), weight(0, 1.5f);
  Spheres spheres;
  for (int i = 0; i < count; ++i) {
    const Vec3 centre = random_vector(random, 1);
    const float r = radius(random);
    spheres.add(centre, r, weight(random));
  }
  return spheres;
}
inline Points random_points(std::mt19937& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const Vec3 position = random_vector(random, 1);
    points.add(position, random_direction(random));
  }
  return points;
}

struct View {
  double xi, delta2;
};
inline View view_of(const SphereSoa& s, std::uint32_t i, const KeyPointSoa& p, std::uint32_t k) {
  const double dx = double(s.x[i]) - p.x[k], dy = double(s.y[i]) - p.y[k], dz = double(s.z[i]) - p.z[k];
  const double inverse = s.inverse_radius[i];
  return {(dx * p.nx[k] + dy * p.ny[k] + dz * p.nz[k]) * inverse,
          (dx * dx + dy * dy + dz * dz) * inverse * inverse};
}

inline double reference_norm_sum(const SphereSoa& s, const KeyPointSoa& p, std::uint32_t k,
                                 const Kernel& kernel) {
  double sum = 0;
  for (std::uint32_t i = 0; i < s.count; ++i) {
    const View v = view_of(s, i, p, k);
    sum += std::pow(std::max(shadow_term(kernel.form, v.xi, v.delta2), 0.0), double(kernel.gamma));
  }
  return sum;
}

// The tables this processor can run.
inline std::vector<const ShadowKernels*> available_kernels() {
  std::vector<const ShadowKernels*> tables;
  for (const Isa isa : all_isas)
    if (const ShadowKernels* table = shadow_kernels(isa)) tables.push_back(table);
  return tables;
}

}  // namespace nook::test
