#include "bakers/lab/crowd/shadow_ratio.h"

#include <algorithm>
#include <cmath>
#include <nook/nook_bake.hpp>
#include <numbers>

namespace crowd::lab {
namespace {

using namespace nook::lab::crowd;

constexpr float pi = std::numbers::pi_v<float>;

struct Beam {
  glm::vec3 direction, irradiance;  // irradiance of a surface that faces the direction
};

// Reduces the environment to few directions, so that its light can be summed at each vertex. Each direction
// represents `block` x `block` texels.
std::vector<Beam> beams_of(const nook_bake_environment& map) {
  constexpr std::uint32_t block = 4;
  std::vector<Beam> beams;
  for (std::uint32_t top = 0; top < map.height; top += block)
    for (std::uint32_t left = 0; left < map.width; left += block) {
      Beam beam{};
      for (std::uint32_t y = top; y < std::min(top + block, map.height); ++y) {
        const float polar = pi * (float(y) + 0.5f) / float(map.height);
        const float solid_angle = 2 * pi / float(map.width) * pi / float(map.height) * std::sin(polar);
        for (std::uint32_t x = left; x < std::min(left + block, map.width); ++x) {
          const float azimuth = 2 * pi * ((float(x) + 0.5f) / float(map.width) - 0.5f);
          const float* rgb = &map.rgb[3 * (std::size_t(y) * map.width + x)];
          const glm::vec3 power = solid_angle * glm::vec3(rgb[0], rgb[1], rgb[2]);
          beam.irradiance += power;
          beam.direction +=
              (power.r + power.g + power.b) * glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                        std::sin(polar) * std::sin(azimuth));
        }
      }
      const float length = glm::length(beam.direction);
      if (length <= 0) continue;
      beam.direction /= length;
      beams.push_back(beam);
    }
  return beams;
}

glm::vec3 open_irradiance(const std::vector<Beam>& beams, const glm::vec3& normal) {
  glm::vec3 sum(0);
  for (const Beam& beam : beams) sum += std::max(glm::dot(beam.direction, normal), 0.0f) * beam.irradiance;
  return sum;
}

// Returns the normals of the points in the order that traced_irradiance uses: first the vertices of the
// receivers, then the points of the patch.
std::vector<float> normals_of(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                              const FloorPatch& patch) {
  std::vector<float> normals;
  for (const std::uint32_t r : receivers) {
    const Body body = crowd.body(r);
    normals.insert(normals.end(), body.normals.begin(), body.normals.end());
  }
  for (std::uint32_t i = 0; i < patch.side * patch.side; ++i) normals.insert(normals.end(), {0, 1, 0});
  return normals;
}

// Returns the irradiance of the points without any occluder. The rays of a point depend only on its index and
// its normal, so they are the same rays as with bodies.
std::vector<float> traced_without_bodies(const std::vector<float>& normals,
                                         const nook_bake_environment& environment,
                                         const TraceSettings& settings) {
  const std::vector<float> origins(normals.size(), 0.0f);
  nook_bake_irradiance_desc desc;
  nook::bake::check(nook_bake_irradiance_desc_init(&desc));
  desc.positions = origins.data();
  desc.normals = normals.data();
  desc.point_count = std::uint32_t(normals.size() / 3);
  desc.environment = environment;
  desc.rays = settings.rays;
  desc.seed = settings.seed;
  desc.max_bounces = 0;
  std::vector<float> irradiance(normals.size());
  nook::bake::check(nook_bake_trace_irradiance(&desc, irradiance.data(), desc.point_count));
  return irradiance;
}

// Replaces the three channels of each vertex by the mean over the vertex and all vertices that share a
// triangle with it.
void average_over_edges(std::vector<float>& values, const std::vector<std::uint32_t>& triangles) {
  std::vector<float> sums = values, counts(values.size() / 3, 1.0f);
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    for (int k = 0; k < 6; ++k) {
      const std::uint32_t to = triangles[t + k % 3], from = triangles[t + (k % 3 + 1 + k / 3) % 3];
      for (std::size_t c = 0; c < 3; ++c) sums[3 * to + c] += values[3 * from + c];
      counts[to] += 1;
    }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = sums[i] / counts[i / 3];
}

// Smooths the three channels along the rows or the columns of the square, with the binomial weights 1, 4, 6,
// 4, 1.
void average_along(std::vector<float>& values, int side, int step, int other_step) {
  constexpr float weights[5] = {1 / 16.0f, 4 / 16.0f, 6 / 16.0f, 4 / 16.0f, 1 / 16.0f};
  const std::vector<float> before = values;
  for (int line = 0; line < side; ++line)
    for (int i = 0; i < side; ++i)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int k = -2; k <= 2; ++k)
          sum += weights[k + 2] *
                 before[std::size_t(3 * (line * other_step + std::clamp(i + k, 0, side - 1) * step) + c)];
        values[std::size_t(3 * (line * other_step + i * step) + c)] = sum;
      }
}

// Divides the irradiance by the irradiance that the same rays find without bodies.
void divide(std::vector<float>& irradiance, const float* without) {
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] /= std::max(without[i], 1e-6f);
}

void multiply_open(std::vector<float>& share, const float* normals, const std::vector<Beam>& beams) {
  for (std::size_t i = 0; i < share.size(); i += 3) {
    const glm::vec3 open = open_irradiance(beams, {normals[i], normals[i + 1], normals[i + 2]});
    for (int c = 0; c < 3; ++c) share[i + std::size_t(c)] *= open[c];
  }
}

}  // namespace

TracedIrradiance smooth_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch& patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings) {
  TracedIrradiance traced = traced_irradiance(crowd, receivers, &patch, environment, settings);
  const std::vector<float> normals = normals_of(crowd, receivers, patch);
  const std::vector<float> without = traced_without_bodies(normals, environment, settings);
  const std::vector<Beam> beams = beams_of(environment);
  std::size_t first = 0;
  for (std::vector<float>& body : traced.bodies) {
    divide(body, &without[first]);
    average_over_edges(body, crowd.triangles());
    multiply_open(body, &normals[first], beams);
    first += body.size();
  }
  divide(traced.floor, &without[first]);
  const int side = int(patch.side);
  average_along(traced.floor, side, 1, side);
  average_along(traced.floor, side, side, 1);
  // All points of the floor have the same normal.
  const glm::vec3 open = open_irradiance(beams, {0, 1, 0});
  for (std::size_t i = 0; i < traced.floor.size(); ++i) traced.floor[i] *= open[int(i % 3)];
  return traced;
}

}  // namespace crowd::lab
