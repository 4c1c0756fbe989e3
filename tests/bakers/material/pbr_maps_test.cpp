// The maps of physically based materials as surfaces.
#include "bakers/material/pbr_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "bakers/material/periodic_tile.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/trace_material.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

PbrMaps flat_maps(std::uint32_t side, Vec3 colour, float roughness, float metalness) {
  PbrMaps maps;
  maps.side = side;
  const std::size_t points = std::size_t(side) * side;
  maps.base_colour.assign(points, colour);
  maps.squared_width.assign(points, float(std::pow(double(roughness), 4)));
  maps.metalness.assign(points, metalness);
  return maps;
}

TraceSettings plain(std::uint32_t texels) {
  TraceSettings s;
  s.width = s.height = texels;
  s.samples = 1;
  s.bounces = 0;
  return s;
}

float value(const RawMaterial& raw, std::size_t light, std::size_t channel, std::size_t view, std::size_t x,
            std::size_t y) {
  return raw.btf[(((3 * light + channel) * raw.views.size() + view) * raw.width + x) * raw.height + y];
}

// The BRDF of glTF's appendix B in double precision, with masking as 1 / (1 + Lambda(light) + Lambda(view)).
double closed_form(double base, double roughness, double metalness, Vec3 view, Vec3 light) {
  const double a = roughness * roughness, pi = std::numbers::pi;
  const Vec3 h = normalised(view + light);
  const double n_l = double(light.z), n_v = double(view.z), n_h = double(h.z), v_h = double(dot(view, h));
  const auto lambda = [&](double cosine) {
    const double tangent2 = 1 / (cosine * cosine) - 1;
    return 0.5 * (std::sqrt(1 + a * a * tangent2) - 1);
  };
  const double g = 1 / (1 + lambda(n_l) + lambda(n_v));
  const double d = a * a / (pi * std::pow(n_h * n_h * (a * a - 1) + 1, 2));
  const double f0 = 0.04 * (1 - metalness) + base * metalness;
  const double f = f0 + (1 - f0) * std::pow(1 - v_h, 5);
  return (1 - f) * base * (1 - metalness) / pi + f * d * g / (4 * n_l * n_v);
}

}  // namespace

TEST_CASE("a flat tile of one colour and roughness reflects as the closed form, from everywhere") {
  const auto lights = spiral_directions(9, 70), views = spiral_directions(8, 75);
  struct Surface {
    float roughness, metalness;
  };
  for (const Surface s :
       {Surface{1, 0}, Surface{0.5f, 0}, Surface{0.25f, 0}, Surface{0.6f, 1}, Surface{0.4f, 0.5f}}) {
    const Vec3 colour{0.8f, 0.5f, 0.2f};
    const RawMaterial raw = trace_material(
        surface_of_maps(flat_maps(6, colour, s.roughness, s.metalness), 0.05f, 1), lights, views, plain(4));
    const float channel[] = {colour.x, colour.y, colour.z};
    for (std::size_t l = 0; l < lights.size(); ++l)
      for (std::size_t v = 0; v < views.size(); ++v)
        for (std::size_t c = 0; c < 3; ++c) {
          const double truth = double(lights[l].z) * closed_form(double(channel[c]), double(s.roughness),
                                                                 double(s.metalness), views[v], lights[l]);
          INFO("roughness " << s.roughness << " light " << l << " view " << v);
          // Half floats have 11 bits.
          REQUIRE(double(value(raw, l, c, v, 1, 2)) == Approx(truth).epsilon(1.5e-3));
        }
    for (const float m : raw.mask) REQUIRE(m == 1);
  }
}

TEST_CASE("a ramp's cliff throws the shadow of its height over the slope behind it") {
  // z = H x falls from H to 0 where tiles meet. From (x, H x) the line to a light of slope s = l_z / -l_x,
  // which stands at -x, passes the cliff at H x + s x: it is shadowed where x < H / (H + s).
  const std::uint32_t side = 128;
  PbrMaps maps = flat_maps(side, {0.6f, 0.6f, 0.6f}, 1, 0);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) maps.height.push_back((float(x) + 0.5f) / float(side));
  const float height_m = 0.4f, tile_m = 2, rise = height_m / tile_m;
  const MesoSurface surface = surface_of_maps(maps, height_m, tile_m);
  for (const float slope : {0.5f, 1.0f, 2.5f}) {
    const RawMaterial raw = trace_material(surface, {normalised({-1, 0, slope})}, {Vec3{0, 0, 1}}, plain(64));
    const float end = rise / (rise + slope);
    for (std::uint32_t x = 0; x < 64; ++x) {
      const float at = (float(x) + 0.5f) / 64;
      // The cliff is as wide as the distance of two points, and stands around x = 0.
      if (std::abs(at - end) < 1.5f / side || at < 1.5f / side || at > 1 - 1.5f / side) continue;
      INFO("slope " << slope << " at " << at << ", the shadow ends at " << end);
      CHECK((value(raw, 0, 0, 0, x, 20) > 0) == (at > end));
    }
  }
}

TEST_CASE("maps moved by half a tile give textures moved by half a tile") {
  const std::uint32_t side = 32;
  const auto maps_from = [&](std::uint32_t shift) {
    PbrMaps maps = flat_maps(side, {}, 0.7f, 0);
    maps.height.resize(std::size_t(side) * side);
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::size_t at = std::size_t(y) * side + (x + shift) % side;
        const float wave = 0.5f + 0.5f * std::sin(0.6f * float(x)) * std::cos(0.3f * float(y));
        maps.height[at] = wave;
        maps.base_colour[at] = {wave, 0.5f, 1 - wave};
      }
    return maps;
  };
  const auto set = spiral_directions(5, 60);
  TraceSettings settings = plain(16);
  settings.bounces = 1;
  settings.bounce_rays = 256;
  const RawMaterial a = trace_material(surface_of_maps(maps_from(0), 0.2f, 1), set, set, settings);
  const RawMaterial b = trace_material(surface_of_maps(maps_from(side / 2), 0.2f, 1), set, set, settings);
  std::size_t differing = 0, values = 0;
  for (std::size_t row = 0; row < a.light_rows(); ++row)
    for (std::size_t v = 0; v < set.size(); ++v)
      for (std::size_t x = 0; x < 16; ++x)
        for (std::size_t y = 0; y < 16; ++y, ++values)
          differing += std::abs(value(a, row / 3, row % 3, v, x, y) -
                                value(b, row / 3, row % 3, v, (x + 8) % 16, y)) > 0.02f;
  // Rays along edges of shadows may fall to their other side; 256 rays of a vertex leave less noise than
  // 0.02.
  CHECK(differing < values / 100);
}

TEST_CASE("slopes of heights and of normal maps tilt the normals; those that vary widen the gloss") {
  const std::uint32_t side = 16;
  PbrMaps maps = flat_maps(side, {1, 1, 1}, 0.5f, 0);
  const double turn = 2 * std::numbers::pi;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      maps.height.push_back(
          float(std::sin(turn * (x + 0.5) / side) + 0.5 * std::cos(turn * (y + 0.5) / side)));
  const MesoSurface from_heights = surface_of_maps(maps, 0.02f, 1);
  // The central difference of a sine of step h is its slope times sin(w h) / (w h).
  const double w = turn, h = 1.0 / side, shrink = std::sin(w * h) / (w * h);
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const Vec3 n = from_heights.normal[std::size_t(y) * (side + 1) + x];
      CHECK(double(-n.x / n.z) == Approx(0.02 * w * shrink * std::cos(turn * (x + 0.5) / side)).margin(1e-5));
      CHECK(double(-n.y / n.z) ==
            Approx(-0.01 * w * shrink * std::sin(turn * (y + 0.5) / side)).margin(1e-5));
    }
  maps.slope.assign(std::size_t(side) * side, {0.5f, -0.25f, 0.03f});
  const MesoSurface from_map = surface_of_maps(maps, 0.02f, 1);
  CHECK(length(from_map.normal[0] - normalised({-0.5f, 0.25f, 1})) < 1e-6f);
  CHECK(from_map.ggx_width[0] == Approx(std::sqrt(std::pow(0.5, 4) + 2 * 0.03)));
}

TEST_CASE(
    "an image on another grid keeps its mean where it is finer, and is interpolated where it is coarser") {
  // Finer: 64 columns to 8 points. A sine of one period under a tent of radius r = 1 / 8 is scaled by
  // (sin(pi r) / (pi r))^2, up to the 8 texels that sample the tent.
  TileFilter fine(64, 4, 8, 1);
  for (std::uint32_t y = 0; y < 4; ++y) {
    std::vector<float> row;
    for (int x = 0; x < 64; ++x) row.push_back(float(2 + std::sin(2 * std::numbers::pi * (x + 0.5) / 64)));
    fine.add_row(y, row);
  }
  const double r = std::numbers::pi / 8, scale = std::pow(std::sin(r) / r, 2);
  const std::vector<float> coarse = fine.result();
  double sum = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    sum += double(coarse[i]);
    CHECK(double(coarse[i]) ==
          Approx(2 + scale * std::sin(2 * std::numbers::pi * (double(i % 8) + 0.5) / 8)).margin(2e-3));
  }
  CHECK(sum / double(coarse.size()) == Approx(2).epsilon(1e-6));
  // Coarser: two texels at 1/4 and 3/4, linear between them and round the tile.
  TileFilter wide(2, 1, 4, 1);
  wide.add_row(0, std::vector<float>{0, 1});
  const float expected[] = {0.25f, 0.25f, 0.75f, 0.75f};
  for (std::size_t i = 0; i < 16; ++i) CHECK(wide.result()[i] == Approx(expected[i % 4]));
}

TEST_CASE("surfaces of maps that are not a material are refused") {
  const auto refusal = [](float range, float scale, float side) {
    PbrMaps maps = flat_maps(4, {1, 1, 1}, 1, 0);
    maps.height.assign(16, 0);
    maps.height[3] = range;
    try {
      surface_of_maps(maps, scale, side);
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      return std::string(failure.what());
    }
    return std::string();
  };
  CHECK(refusal(1, 0.4f, 1).empty());
  CHECK(refusal(1, 0, 1).empty());
  CHECK(refusal(1, 0.6f, 1).find("tiles high") != std::string::npos);
  CHECK(refusal(std::numeric_limits<float>::infinity(), 0.1f, 1).find("tiles high") != std::string::npos);
  CHECK(refusal(1, -1, 1).find("the height scale") != std::string::npos);
  CHECK(refusal(1, 0.1f, 0).find("the side of the tile") != std::string::npos);
  TraceSettings large;
  large.width = large.height = 4096;
  const auto set = spiral_directions(100);
  CHECK_THROWS_AS(trace_material(surface_of_maps(flat_maps(4, {1, 1, 1}, 1, 0), 0, 1), set, set, large),
                  Failure);
}
