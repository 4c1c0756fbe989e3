#include "bakers/lab/material/pbr_tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/material/pbr_maps.h"
#include "bakers/material/periodic_tile.h"
#include "bakers/material/tile_heights.h"
#include "bakers/tensor/blocks.h"

namespace nook::lab {
namespace {

using namespace bake;
using namespace bake::material;

using Eigen::Index;
using tensor::Matrix;

Taps taps_of(const PbrTile& tile, float x, float y) {
  return taps_at(tile.width, tile.height, x, y);
}

HeightMap heights_of(const PbrTile& tile) {
  return {tile.width, tile.height, tile.heights};
}

// Returns whether a point of the relief is visible from the light. The relief blocks the light only where it
// is above the ray by more than a hundredth of the height range.
bool is_lit(const PbrTile& tile, HeightRange range, Vec3 point, Vec3 light) {
  const float depth = range.high - point.z;
  const int steps = steps_of(heights_of(tile), light, depth);
  for (int i = 1; i <= steps; ++i) {
    const float rise = depth * float(i) / float(steps);
    const float margin = 0.01f * (range.high - range.low);
    if (height_at(heights_of(tile), point.x + light.x / light.z * rise, point.y + light.y / light.z * rise) >
        point.z + rise + margin)
      return false;
  }
  return true;
}

// The values of the maps at a point.
struct Shading {
  Vec3 diffuse, normal;
  float gloss_width = 1;
};

Vec3 normal_of(float slope_x, float slope_y) {
  return normalised(Vec3{-slope_x, -slope_y, 1});
}

Vec3 radiance_of(const Shading& s, Vec3 view, Vec3 light) {
  constexpr Vec3 reflectance{dielectric_reflectance, dielectric_reflectance, dielectric_reflectance};
  const float cosine = dot(s.normal, light);
  if (!(cosine > 0)) return {};
  return cosine / std::numbers::pi_v<float> *
         microfacet_reflection({s.diffuse, reflectance, s.gloss_width}, s.normal, view, light);
}

// Returns an interpolated value of a raw material at any point of its plane.
float raw_at(const RawMaterial& raw, const Taps& taps, std::size_t row, std::size_t view) {
  return mean_of(taps, &raw.btf[(row * raw.views.size() + view) * raw.texels()]);
}

// The radiance that a texel has in one view under one light.
struct Observation {
  Vec3 view, light, value;
};

std::vector<Observation> observe(const RawMaterial& raw, const PbrTile& tile, HeightRange range,
                                 std::size_t texel) {
  const Vec3 point{(float(texel / raw.height) + 0.5f) / float(raw.width),
                   (float(texel % raw.height) + 0.5f) / float(raw.height), tile.heights[texel]};
  const float nearest = 1.0f / float(std::max(raw.width, raw.height));
  std::vector<bool> lit(raw.lights.size());
  for (std::size_t l = 0; l < lit.size(); ++l)
    lit[l] = !tile.has_shadows || is_lit(tile, range, point, raw.lights[l]);
  std::vector<Observation> found;
  for (std::size_t v = 0; v < raw.views.size(); ++v) {
    const Vec3 view = raw.views[v];
    const float x = point.x - view.x / view.z * point.z, y = point.y - view.y / view.z * point.z;
    if (first_height(heights_of(tile), range, x, y, view) > point.z + nearest) continue;
    const Taps taps = taps_of(tile, x, y);
    for (std::size_t l = 0; l < lit.size(); ++l)
      if (lit[l])
        found.push_back({view,
                         raw.lights[l],
                         {raw_at(raw, taps, 3 * l, v), raw_at(raw, taps, 3 * l + 1, v),
                          raw_at(raw, taps, 3 * l + 2, v)}});
  }
  return found;
}

// Finds the best diffuse colour for the slopes and gloss width in `s`, and returns the remaining error. The
// problem is linear in the colour.
double best_diffuse(const std::vector<Observation>& seen, Shading& s) {
  double signal[3] = {}, square = 0, error = 0;
  std::vector<float> rest(3 * seen.size()), base(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    s.diffuse = {};
    const float gloss = radiance_of(s, seen[i].view, seen[i].light).x;
    s.diffuse = {1, 1, 1};
    base[i] = radiance_of(s, seen[i].view, seen[i].light).x - gloss;
    square += double(base[i]) * base[i];
    const float value[] = {seen[i].value.x, seen[i].value.y, seen[i].value.z};
    for (int c = 0; c < 3; ++c) {
      rest[3 * i + c] = value[c] - gloss;
      signal[c] += double(rest[3 * i + c]) * base[i];
    }
  }
  float colour[3];
  for (int c = 0; c < 3; ++c) colour[c] = square > 0 ? std::clamp(float(signal[c] / square), 0.0f, 1.0f) : 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double off = rest[i] - colour[i % 3] * base[i / 3];
    error += off * off;
  }
  s.diffuse = {colour[0], colour[1], colour[2]};
  return error;
}

// The two slopes and the logarithm of the gloss width.
using Unknowns = Eigen::Vector3d;

Shading shading_of(const Unknowns& u) {
  Shading s;
  s.normal = normal_of(float(u[0]), float(u[1]));
  s.gloss_width = std::clamp(float(std::exp(u[2])), ggx_width(0), 1.0f);
  return s;
}

// Searches along the axes. If no step lowers the error, the steps are made smaller.
Unknowns fit_texel(const std::vector<Observation>& seen, Unknowns u) {
  Shading s = shading_of(u);
  double best = best_diffuse(seen, s);
  Unknowns step(0.3, 0.3, 0.7);
  for (int round = 0; round < 8; ++round) {
    bool better = false;
    for (int i = 0; i < 6; ++i) {
      Unknowns other = u;
      other[i / 2] += i % 2 ? step[i / 2] : -step[i / 2];
      s = shading_of(other);
      const double error = best_diffuse(seen, s);
      if (!(error < best)) continue;
      best = error;
      u = other;
      better = true;
    }
    if (!better) step *= 0.4;
  }
  return u;
}

}  // namespace

Matrix draw_pbr_tile(const PbrTile& tile, Vec3 view, std::span<const Vec3> lights) {
  const HeightRange range = range_of(heights_of(tile));
  Matrix drawn(Index(3 * lights.size()), Index(tile.texels()));
  for (std::size_t t = 0; t < tile.texels(); ++t) {
    const float x = (float(t / tile.height) + 0.5f) / float(tile.width),
                y = (float(t % tile.height) + 0.5f) / float(tile.height);
    const float z = first_height(heights_of(tile), range, x, y, view);
    const Vec3 point{x + view.x / view.z * z, y + view.y / view.z * z, z};
    const Taps taps = taps_of(tile, point.x, point.y);
    const Shading s{mean_of(taps, tile.diffuse.data()),
                    normal_of(mean_of(taps, tile.slope_x.data()), mean_of(taps, tile.slope_y.data())),
                    mean_of(taps, tile.gloss_width.data())};
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const bool lit = !tile.has_shadows || is_lit(tile, range, point, lights[l]);
      const Vec3 radiance = lit ? radiance_of(s, view, lights[l]) : Vec3{};
      const float rgb[] = {radiance.x, radiance.y, radiance.z};
      for (std::size_t c = 0; c < 3; ++c) drawn(Index(3 * l + c), Index(t)) = rgb[c];
    }
  }
  return drawn;
}

PbrTile fit_pbr_tile(const RawMaterial& raw, bool has_shadows) {
  PbrTile tile;
  tile.width = raw.width;
  tile.height = raw.height;
  const std::size_t texels = raw.texels();
  tile.has_shadows = has_shadows;
  tile.heights = heights_of_views(raw);
  tile.diffuse.resize(texels);
  tile.slope_x.resize(texels);
  tile.slope_y.resize(texels);
  tile.gloss_width.resize(texels);
  const HeightRange range = range_of(heights_of(tile));
  tensor::for_each_block(texels, 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const std::vector<Observation> seen = observe(raw, tile, range, t);
      const Unknowns u = fit_texel(seen, Unknowns(0, 0, -1));
      Shading s = shading_of(u);
      best_diffuse(seen, s);
      tile.diffuse[t] = s.diffuse;
      tile.slope_x[t] = float(u[0]);
      tile.slope_y[t] = float(u[1]);
      tile.gloss_width[t] = s.gloss_width;
    }
  });
  return tile;
}

BtfError measure_pbr_tile(const RawMaterial& raw, const PbrTile& tile) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  std::vector<BtfError> part(views);
  tensor::for_each_block(views, 1, [&](std::size_t view, std::size_t) {
    const Matrix drawn = draw_pbr_tile(tile, raw.views[view], raw.lights);
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      add_error({&raw.btf[(row * views + view) * texels], texels}, drawn.row(Index(row)).data(), part[view]);
  });
  return sum_of_errors(part);
}

}  // namespace nook::lab
