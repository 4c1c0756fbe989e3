#include "bakers/lab/probe/lookups.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/floats.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::lab {
namespace {

using bake::FlushDenormals;
using probe::Probes;

void blend(const Probes& probes, const std::array<std::size_t, 8>& corner, const std::array<float, 8>& weight,
           std::span<Vec3> coefficients) {
  std::fill(coefficients.begin(), coefficients.end(), Vec3{});
  float sum = 0;
  for (const float w : weight) sum += w;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      coefficients[i] += probes.of(corner[c])[i] * (weight[c] / sum);
}

}  // namespace

Lookup own_lookup(const Probes& probes, float offset) {
  return [&probes, offset](Vec3 position, Vec3 normal, std::span<Vec3> coefficients) {
    const Vec3 step = by_channel(normal, probes.grid.spacing_ws) * offset;
    nook::probe::interpolate(probes, position + step, normal, coefficients);
  };
}

Lookup visibility_lookup(const Probes& probes, const bake::LitScene& scene,
                         const std::vector<Vec3>& probe_positions_ws, float origin_offset) {
  return [&probes, &scene, &probe_positions_ws, origin_offset](Vec3 position, Vec3 normal,
                                                               std::span<Vec3> coefficients) {
    const FlushDenormals flush;
    const auto place = nook::probe::place_in(probes.grid, position);
    const Vec3 from = position + normal * origin_offset;
    std::array<float, 8> weight = nook::probe::corner_weights(place.in_cell, float(NOOK_GRID_LEAST_SHARE)),
                         seen = weight;
    float sum = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec3 to = probe_positions_ws[place.corner[c]] - from;
      if (scene.nearest(from, to).distance < 1) seen[c] = 0;
      sum += seen[c];
    }
    blend(probes, place.corner, sum > 0 ? seen : weight, coefficients);
  };
}

Moments::Moments(const bake::LitScene& scene, const std::vector<Vec3>& probe_positions_ws, Vec3 spacing_ws)
    : positions_ws_(probe_positions_ws), rays_(probe_positions_ws.size()), spacing_ws_(spacing_ws) {
  constexpr std::size_t ray_count = 1024;
  const float most = 1.5f * length(spacing_ws);  // distances are clamped to this value, because greater
                                                 // distances carry no useful information
  std::array<Vec3, ray_count> direction;
  nook::probe::vogel_sphere(direction);
  tbb::parallel_for(std::size_t(0), rays_.size(), [&](std::size_t p) {
    const FlushDenormals flush;
    for (const Vec3 d : direction)
      rays_[p].push_back({d, std::min(scene.nearest(positions_ws_[p], d).distance, most)});
  });
}

float Moments::bound(std::size_t probe, Vec3 to_place, float distance) const {
  constexpr float sharpness = 50;
  double weight = 0, mean = 0, square = 0;
  for (const Ray& ray : rays_[probe]) {
    const float cosine = dot(ray.direction, to_place);
    if (cosine < 0.8f) continue;  // the weight is below 1e-4
    const double w = std::pow(double(cosine), double(sharpness));
    weight += w;
    mean += w * double(ray.distance);
    square += w * double(ray.distance) * double(ray.distance);
  }
  mean /= weight;
  if (double(distance) <= mean) return 1;
  const double variance = std::abs(square / weight - mean * mean), beyond = double(distance) - mean;
  const double chebyshev = variance / (variance + beyond * beyond);
  return float(std::max(chebyshev * chebyshev * chebyshev, 0.0));
}

Lookup Moments::lookup(const Probes& probes) const {
  return [this, &probes](Vec3 position, Vec3 normal, std::span<Vec3> coefficients) {
    constexpr float normal_bias = 0.1f, least = 1e-6f, crushed_below = 0.2f;
    const float shortest = std::min({spacing_ws_.x, spacing_ws_.y, spacing_ws_.z});
    const auto place = nook::probe::place_in(probes.grid, position);
    std::array<float, 8> weight = nook::probe::corner_weights(place.in_cell, float(NOOK_GRID_LEAST_SHARE));
    const Vec3 biased = position + normal * (normal_bias * shortest);
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec3 to_probe = positions_ws_[place.corner[c]] - position,
                 to_place = biased - positions_ws_[place.corner[c]];
      const float wrapped = 0.5f * (dot(to_probe * (1 / std::max(length(to_probe), 1e-6f)), normal) + 1);
      const float distance = length(to_place);
      float w = wrapped * wrapped + 0.2f;
      if (distance > 1e-4f) w *= bound(place.corner[c], to_place * (1 / distance), distance);
      w = std::max(w, least);
      if (w < crushed_below) w *= w * w / (crushed_below * crushed_below);
      weight[c] *= w;
    }
    blend(probes, place.corner, weight, coefficients);
  };
}

Probes zonal_in_half_floats(const Probes& probes) {
  Probes zonal = probes;
  zonal.basis.count = probe::zonal_count;
  zonal.coefficients.clear();
  const auto half = [](float value) { return from_half(to_half(value)); };
  for (std::size_t p = 0; p < probes.grid.size(); ++p)
    for (const Vec3 v : probe::to_zonal(probes.of(p)))
      zonal.coefficients.push_back({half(v.x), half(v.y), half(v.z)});
  return zonal;
}

}  // namespace nook::lab
