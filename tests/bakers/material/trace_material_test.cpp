#include "bakers/material/trace_material.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/material/plates.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

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

}  // namespace

TEST_CASE("a flat plate shines as Lambert says, from everywhere") {
  const Vec3 albedo{0.8f, 0.5f, 0.2f};
  const auto set = spiral_directions(7, 70);
  const RawMaterial raw = trace_material(test::flat_plate(0, albedo), set, set, plain(4));
  const float channel[] = {albedo.x, albedo.y, albedo.z};
  for (std::size_t l = 0; l < 7; ++l)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t v = 0; v < 7; ++v)
        // Files hold half floats, of 11 bits.
        REQUIRE(value(raw, l, c, v, 1, 2) ==
                Approx(channel[c] * set[l].z * std::numbers::inv_pi_v<float>).epsilon(1e-3));
  for (const float m : raw.mask) REQUIRE(m == 1);
}

TEST_CASE("a strip occludes and shadows where the ray's slope says, across the tile's border") {
  // The strip lies 0.1 above a ground of the same colour. A light of slope 1 along x moves its shadow by 0.1.
  const MesoSurface surface = test::strip_over_ground(0.25f, 0.5f, 0.1f, {0.6f, 0.6f, 0.6f});
  const Vec3 above{0, 0, 1}, slanted = normalised({1, 0, 1}), other_way = normalised({-4, 0, 1});
  const std::uint32_t texels = 80;
  const RawMaterial raw = trace_material(surface, {above, slanted, other_way}, {above}, plain(texels));
  for (std::uint32_t x = 0; x < texels; ++x) {
    const float at = (float(x) + 0.5f) / float(texels);
    const bool on_strip = at > 0.25f && at < 0.5f;
    INFO("texel " << x);
    CHECK((value(raw, 0, 0, 0, x, 3) > 0.1f));
    // The light comes from +x: the shadow falls to -x.
    const bool shadow = at > 0.15f && at < 0.4f && !on_strip;
    CHECK((value(raw, 1, 0, 0, x, 3) > 0) == !shadow);
    // Slope 4 from -x: the shadow of 0.25..0.5 falls on 0.65..0.9.
    const bool far_shadow = at > 0.65f && at < 0.9f;
    CHECK((value(raw, 2, 0, 0, x, 3) > 0) == !far_shadow);
  }
}

TEST_CASE("heights are the highest points over the texels, and over gaps come from the surroundings") {
  const std::vector<Vec3> up{{0, 0, 1}};
  const Vec3 grey{0.5f, 0.5f, 0.5f};
  TraceSettings settings{8, 4, 2, 0, 1, 1, true};
  // Half of the samples of the third column lie under the strip.
  const RawMaterial strip =
      trace_material(test::strip_over_ground(0.3125f, 0.75f, 0.25f, grey), up, up, settings);
  const std::vector<float> columns{0, 0, 0.125f, 0.25f, 0.25f, 0.25f, 0, 0};
  REQUIRE(strip.heights.size() == 32);
  for (std::size_t x = 0; x < 8; ++x)
    for (std::size_t y = 0; y < 4; ++y) CHECK(strip.heights[x * 4 + y] == Approx(columns[x]).margin(1e-5));

  MesoSurface half;
  test::add_quad(half, {0, 0, 0.25f}, {0.5f, 0, 0.25f}, {0.5f, 1, 0.25f}, {0, 1, 0.25f}, grey);
  for (const float height : trace_material(half, up, up, settings).heights)
    CHECK(height == Approx(0.25f).margin(1e-5));
  settings.finds_heights = false;
  CHECK(trace_material(half, up, up, settings).heights.empty());
}

TEST_CASE("the VOTF is where the view meets the structure, on the plane z = 0") {
  // A lone strip at height 0.1: texel x of the plane z = 0 sees it along (slope, 0, 1) where x + 0.1 slope
  // lies on it.
  MesoSurface surface;
  test::add_quad(surface, {0.25f, 0, 0.1f}, {0.5f, 0, 0.1f}, {0.5f, 1, 0.1f}, {0.25f, 1, 0.1f},
                 {0.5f, 0.5f, 0.5f});
  std::vector<Vec3> views;
  for (const float slope : {0.0f, 1.0f, -2.0f, 3.5f, -3.5f})
    views.push_back(normalised({slope, 0.3f * slope, 1}));
  const std::uint32_t texels = 80;
  const RawMaterial raw = trace_material(surface, {Vec3{0, 0, 1}}, views, plain(texels));
  for (std::size_t v = 0; v < views.size(); ++v)
    for (std::uint32_t x = 0; x < texels; ++x) {
      float at = (float(x) + 0.5f) / float(texels) + 0.1f * views[v].x / views[v].z;
      at -= std::floor(at);
      // Exactly on the border either answer is right.
      if (std::abs(at - 0.25f) < 1e-4f || std::abs(at - 0.5f) < 1e-4f) continue;
      INFO("view " << v << " texel " << x);
      CHECK((raw.mask[(v * texels + x) * texels + 5] > 0.5f) == (at > 0.25f && at < 0.5f));
      // The strip's colour, under a light from above, also where the view passes it.
      CHECK(value(raw, 0, 1, v, x, 5) == Approx(0.5f * std::numbers::inv_pi_v<float>).epsilon(1e-3));
    }
}

TEST_CASE("moving the structure by half a tile moves the textures by half their size") {
  MesoParameters p = meso_parameters("roughhole");
  p.detail = 0.25f;
  MesoSurface surface = make_meso_surface(p);
  const auto set = spiral_directions(5, 60);
  TraceSettings settings = plain(16);
  const RawMaterial before = trace_material(surface, set, set, settings);
  for (Vec3& q : surface.position) q.x += 0.5f;
  const RawMaterial after = trace_material(surface, set, set, settings);
  std::size_t differing = 0, values = 0;
  for (std::size_t row = 0; row < before.light_rows(); ++row)
    for (std::size_t v = 0; v < set.size(); ++v)
      for (std::size_t x = 0; x < 16; ++x)
        for (std::size_t y = 0; y < 16; ++y, ++values)
          differing += std::abs(value(before, row / 3, row % 3, v, x, y) -
                                value(after, row / 3, row % 3, v, (x + 8) % 16, y)) > 0.01f;
  // Rays that graze an edge may fall to its other side with other roundings.
  CHECK(differing < values / 200);
}

TEST_CASE("the mean over a tile, its smallest mipmap, is near the mean of what is visible, gaps or not") {
  MesoParameters p = meso_parameters("roughhole");
  p.detail = 0.5f;
  const MesoSurface surface = make_meso_surface(p);
  const std::vector<Vec3> lights = spiral_directions(4, 60), views = spiral_directions(6, 45);
  TraceSettings settings = plain(24);
  settings.samples = 2;
  const RawMaterial coarse = trace_material(surface, lights, views, settings);
  const RawMaterial fine = trace_material(surface, lights, views, plain(96));
  double filled_error = 0, black_error = 0;
  for (std::size_t row = 0; row < fine.light_rows(); ++row)
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto mean = [&](const RawMaterial& raw, bool visible_only) {
        double sum = 0;
        for (std::size_t i = 0; i < raw.texels(); ++i)
          if (!visible_only || raw.mask[v * raw.texels() + i] > 0.5f)
            sum += double(raw.btf[(row * views.size() + v) * raw.texels() + i]);
        return sum;
      };
      const double visible = double(
          std::count(&fine.mask[v * fine.texels()], &fine.mask[v * fine.texels()] + fine.texels(), 1.0f));
      const double truth = mean(fine, true) / visible;
      filled_error += std::abs(mean(coarse, false) / double(coarse.texels()) - truth);
      black_error += std::abs(mean(coarse, true) / double(coarse.texels()) - truth);
    }
  // The texels round a gap are a little darker than the rest, and fill it: docs/lab/materials.md has the
  // method.
  INFO(filled_error << " filled, " << black_error << " black");
  CHECK(filled_error < black_error / 3);
}

TEST_CASE("tracing gives the same bits on one thread and on four, and can be stopped") {
  MesoParameters p = meso_parameters("fiber");
  p.detail = 0.3f;
  const MesoSurface surface = make_meso_surface(p);
  const auto set = spiral_directions(4, 60);
  TraceSettings settings = plain(12);
  settings.bounces = 2;
  settings.bounce_rays = 8;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return trace_material(surface, set, set, settings);
  };
  const RawMaterial one = with_threads(1), four = with_threads(4);
  CHECK(one.btf == four.btf);
  CHECK(one.mask == four.mask);
  CHECK_THROWS_AS(
      trace_material(surface, set, set, settings, [](std::size_t done, std::size_t) { return done < 2; }),
      Failure);
}

TEST_CASE("directions are even on the cap, and bad ones are refused") {
  const auto set = spiral_directions(400, 75);
  double z = 0;
  for (const Vec3 d : set) {
    REQUIRE(length(d) == Approx(1).margin(1e-5));
    z += double(d.z);
  }
  // The mean height of a spherical cap is the middle of its heights; the directions are midpoints of equal
  // areas but for half a step at both ends.
  CHECK(z / 400 == Approx((1 + std::cos(75 * std::numbers::pi / 180)) / 2).margin(1e-3));
  CHECK(set.front().z == 1);
  CHECK(direction_from_angles(75, 0).z == Approx(std::cos(75 * std::numbers::pi / 180)).margin(1e-5));
  CHECK_THROWS_AS(spiral_directions(3), Failure);
  CHECK_THROWS_AS(spiral_directions(10, 90), Failure);
  const MesoSurface plate = test::flat_plate(0, {0.5f, 0.5f, 0.5f});
  CHECK_THROWS_AS(trace_material(plate, {Vec3{0, 0, 2}}, {Vec3{0, 0, 1}}, plain(4)), Failure);
  CHECK_THROWS_AS(trace_material(plate, {Vec3{0, 0, 1}}, {Vec3{1, 0, 0}}, plain(4)), Failure);
  CHECK_THROWS_AS(trace_material(plate, {Vec3{0, 0, 1}}, {}, plain(4)), Failure);
}
