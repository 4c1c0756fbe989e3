#include "bakers/probe/map_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook::bake::probe {
namespace {

// A texel is divided until a basis function changes by at most this amount within a part. The error of the
// midpoint rule is 1/24 of the square of this change.
constexpr double finest_step = 0.1;

std::uint32_t divisions(const Environment& map, const Basis& basis) {
  float sharpest = 16;  // enough for spherical harmonics and dice, which never vary faster
  for (std::uint32_t i = 0; i < basis.count && basis.kind == nook::probe::BasisKind::gaussians; ++i)
    sharpest = std::max(sharpest, basis.sharpness[i]);
  const double texel = std::numbers::pi / map.height();
  return std::uint32_t(std::clamp(std::ceil(texel * std::sqrt(double(sharpest)) / finest_step), 1.0, 64.0));
}

// Texels as separate arrays, so that the compiler can vectorise sums over them.
struct TexelArrays {
  std::vector<float> x, y, z, r, g, b;  // centres; radiance times solid angle
};

TexelArrays texel_arrays(const Environment& map, const Region& region) {
  TexelArrays arrays;
  for (std::uint32_t row = 0; row < map.height(); ++row)
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      const Vec3 direction = map.direction(column, row, 0.5f, 0.5f);
      if (!region.holds(direction)) continue;
      const Vec3 light = map.texel(std::size_t(row) * map.width() + column) * float(map.solid_angle(row));
      arrays.x.push_back(direction.x);
      arrays.y.push_back(direction.y);
      arrays.z.push_back(direction.z);
      arrays.r.push_back(light.x);
      arrays.g.push_back(light.y);
      arrays.b.push_back(light.z);
    }
  return arrays;
}

Vec3 sum_under_cosine(const TexelArrays& texels, Vec3 n, std::size_t begin, std::size_t end) {
  float r = 0, g = 0, b = 0;
#pragma omp simd reduction(+ : r, g, b)
  for (std::size_t i = begin; i < end; ++i) {
    const float cosine = n.x * texels.x[i] + n.y * texels.y[i] + n.z * texels.z[i];
    const float weight = cosine > 0 ? cosine : 0;
    r += weight * texels.r[i];
    g += weight * texels.g[i];
    b += weight * texels.b[i];
  }
  return {r, g, b};
}

}  // namespace

MapIntegrals integrate(const Environment& map, const Region& region) {
  MapIntegrals sum;
  for (std::uint32_t row = 0; row < map.height(); ++row) {
    const double solid_angle = map.solid_angle(row);
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      if (!region.holds(map.direction(column, row, 0.5f, 0.5f))) continue;
      const Vec3 f = map.texel(std::size_t(row) * map.width() + column);
      const double channel[3] = {double(f.x), double(f.y), double(f.z)};
      for (std::size_t c = 0; c < 3; ++c) {
        sum.radiance[c] += solid_angle * channel[c];
        sum.square[c] += solid_angle * channel[c] * channel[c];
      }
    }
  }
  return sum;
}

std::vector<Channels> moments(const Environment& map, const Basis& basis) {
  const std::uint32_t parts = divisions(map, basis);
  const Region region = region_of(basis);
  // Rows are added in order at the end, so that the result has the same bits on any number of threads.
  std::vector<std::vector<Channels>> of_row(map.height(), std::vector<Channels>(basis.count));
  tbb::parallel_for(std::uint32_t(0), map.height(), [&](std::uint32_t row) {
    std::array<float, nook::probe::max_functions> value;
    const double solid_angle = map.solid_angle(row) / (double(parts) * parts);
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      if (!region.holds(map.direction(column, row, 0.5f, 0.5f))) continue;
      const Vec3 f = map.texel(std::size_t(row) * map.width() + column);
      for (std::uint32_t part = 0; part < parts * parts; ++part) {
        const float u = (float(part % parts) + 0.5f) / float(parts);
        const float v = (float(part / parts) + 0.5f) / float(parts);
        nook::probe::evaluate_basis(basis, map.direction(column, row, u, v), value.data());
        for (std::uint32_t i = 0; i < basis.count; ++i) {
          const double weight = solid_angle * double(value[i]);
          of_row[row][i][0] += weight * double(f.x);
          of_row[row][i][1] += weight * double(f.y);
          of_row[row][i][2] += weight * double(f.z);
        }
      }
    }
  });
  std::vector<Channels> sum(basis.count);
  for (const auto& row : of_row)
    for (std::uint32_t i = 0; i < basis.count; ++i)
      for (std::size_t c = 0; c < 3; ++c) sum[i][c] += row[i][c];
  return sum;
}

std::vector<Vec3> map_irradiance(const Environment& map, const Region& region,
                                 std::span<const Vec3> normals) {
  constexpr std::size_t block = 1024;  // a float sum of this many terms is accurate enough
  const TexelArrays texels = texel_arrays(map, region);
  std::vector<Vec3> irradiance(normals.size());
  tbb::parallel_for(std::size_t(0), normals.size(), [&](std::size_t n) {
    Channels sum{};
    for (std::size_t i = 0; i < texels.x.size(); i += block) {
      const Vec3 part = sum_under_cosine(texels, normals[n], i, std::min(i + block, texels.x.size()));
      sum[0] += double(part.x);
      sum[1] += double(part.y);
      sum[2] += double(part.z);
    }
    irradiance[n] = {float(sum[0]), float(sum[1]), float(sum[2])};
  });
  return irradiance;
}

Environment reduced(Environment map, std::uint32_t most_columns) {
  while (map.width() > most_columns && map.width() % 2 == 0 && map.height() % 2 == 0) {
    const std::uint32_t width = map.width() / 2, height = map.height() / 2;
    std::vector<float> rgb;
    for (std::uint32_t row = 0; row < height; ++row) {
      const double top = map.solid_angle(2 * row), bottom = map.solid_angle(2 * row + 1);
      const auto upper = float(0.5 * top / (top + bottom)), lower = float(0.5 * bottom / (top + bottom));
      for (std::uint32_t column = 0; column < width; ++column) {
        const std::size_t at = std::size_t(2 * row) * map.width() + 2 * column, below = at + map.width();
        const Vec3 mean =
            upper * (map.texel(at) + map.texel(at + 1)) + lower * (map.texel(below) + map.texel(below + 1));
        rgb.insert(rgb.end(), {mean.x, mean.y, mean.z});
      }
    }
    map = Environment(width, height, std::move(rgb));
  }
  return map;
}

}  // namespace nook::bake::probe
