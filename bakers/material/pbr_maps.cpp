#include "bakers/material/pbr_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/material/periodic_tile.h"
#include "sdk/src/core/failure.h"

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
  const float density = a2 / (slope * slope);  // the density, times pi
  const float masked =
      n_l * std::sqrt(n_v * n_v * (1 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1 - a2) + a2);
  const float gloss = masked > 0 ? density * 0.5f / masked : 0;
  const float grazing = fifth_power(1 - std::min(v_h, 1.0f));
  const Vec3 fresnel = s.reflectance + (Vec3{1, 1, 1} - s.reflectance) * grazing;
  return each_times(Vec3{1, 1, 1} - fresnel, s.diffuse) + fresnel * gloss;
}

namespace {

constexpr float most_height = 0.5f;  // tiles

// Returns central differences of the heights. At the border, uses the heights of the next tile.
MapSlope slope_of(const std::vector<float>& z, std::uint32_t side, std::uint32_t x, std::uint32_t y) {
  const auto at = [&](std::uint32_t column, std::uint32_t row) {
    return z[std::size_t(row % side) * side + column % side];
  };
  const float per_tile = 0.5f * float(side);
  return {(at(x + 1, y) - at(x + side - 1, y)) * per_tile, (at(x, y + 1) - at(x, y + side - 1)) * per_tile,
          0};
}

void add_vertex(const PbrMaps& maps, const std::vector<float>& z, std::uint32_t x, std::uint32_t y,
                MesoSurface& surface) {
  const std::uint32_t side = maps.side, column = x % side, row = y % side;
  const std::size_t at = std::size_t(row) * side + column;
  surface.position.push_back({(float(x) + 0.5f) / float(side), (float(y) + 0.5f) / float(side), z[at]});
  const MapSlope slope = maps.slope.empty() ? slope_of(z, side, column, row) : maps.slope[at];
  surface.normal.push_back(normalised({-slope.x, -slope.y, 1}));
  const float metal = maps.metalness.empty() ? 0 : maps.metalness[at];
  const Vec3 base = maps.base_colour[at];
  constexpr Vec3 dielectric{dielectric_reflectance, dielectric_reflectance, dielectric_reflectance};
  surface.albedo.push_back(base * (1 - metal));
  surface.reflectance.push_back(dielectric * (1 - metal) + base * metal);
  const float squared_width = maps.squared_width.empty() ? 1 : maps.squared_width[at];
  surface.ggx_width.push_back(std::min(std::sqrt(squared_width + 2 * slope.variance), 1.0f));
}

}  // namespace

std::vector<float> heights_of_map(const PbrMaps& maps, float height_scale_m, float side_m) {
  if (!(height_scale_m >= 0 && std::isfinite(height_scale_m)))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the height scale is %g metres, need a number from 0 on",
                  double(height_scale_m));
  if (!(side_m > 0 && std::isfinite(side_m)))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the side of the tile is %g metres, need a number above 0",
                  double(side_m));
  const float tiles = height_scale_m / side_m;
  std::vector<float> z(std::size_t(maps.side) * maps.side, 0.0f);
  if (maps.height.empty()) return z;
  const auto [low, high] = std::minmax_element(maps.height.begin(), maps.height.end());
  const float range = (*high - *low) * tiles, middle = *low + (*high - *low) / 2;
  // The condition is negated, so that a NaN is rejected too.
  if (!(range <= most_height))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the surface is %g tiles high, need at most %g; give a smaller height scale or a larger side "
        "of the tile",
        double(range), double(most_height));
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = (maps.height[i] - middle) * tiles;
  return z;
}

PbrMaps heights_at(const PbrMaps& maps, std::uint32_t side) {
  PbrMaps out;
  out.side = side;
  if (maps.height.empty()) return out;
  TileFilter filter(maps.side, maps.side, side, 1);
  for (std::uint32_t y = 0; y < maps.side; ++y)
    filter.add_row(y, std::span(maps.height).subspan(std::size_t(y) * maps.side, maps.side));
  out.height = filter.result();
  return out;
}

MesoSurface surface_of_maps(const PbrMaps& maps, float height_scale_m, float side_m) {
  const std::vector<float> z = heights_of_map(maps, height_scale_m, side_m);
  const std::uint32_t side = maps.side, across = side + 1;
  MesoSurface surface;
  // The last column and row are the first ones of the next tile.
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) add_vertex(maps, z, x, y, surface);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * across + x, b = a + 1, c = a + across, d = c + 1;
      // Splits along the flatter diagonal, so that ridges and valleys keep their shape.
      const auto z_of = [&](std::uint32_t v) { return surface.position[v].z; };
      if (std::abs(z_of(a) - z_of(d)) <= std::abs(z_of(b) - z_of(c))) {
        surface.triangle.push_back({a, b, d});
        surface.triangle.push_back({a, d, c});
      } else {
        surface.triangle.push_back({a, b, c});
        surface.triangle.push_back({b, d, c});
      }
    }
  return surface;
}

}  // namespace nook::bake::material
