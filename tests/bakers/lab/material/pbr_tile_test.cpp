#include "bakers/lab/material/pbr_tile.h"

#include <cmath>

#include "bakers/material/raw_material.h"
#include "bakers/material/tile_heights.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;
using namespace nook::lab;

namespace {

constexpr float turn = 6.2831853f;

// Gentle hills with spots of colour, which the agreement of views needs.
PbrTile hills(std::uint32_t side, float lift) {
  PbrTile tile;
  tile.width = tile.height = side;
  for (std::size_t x = 0; x < side; ++x)
    for (std::size_t y = 0; y < side; ++y) {
      const float u = turn * (float(x) + 0.5f) / float(side), v = turn * (float(y) + 0.5f) / float(side);
      tile.heights.push_back(lift * std::cos(u));
      tile.slope_x.push_back(-turn * lift * std::sin(u));
      tile.slope_y.push_back(0);
      tile.gloss_width.push_back(0.5f);
      const float spots = 0.5f + 0.2f * std::cos(4 * u) + 0.2f * std::cos(5 * v + u);
      tile.diffuse.push_back({spots, 0.7f * spots, 0.4f});
    }
  return tile;
}

RawMaterial drawn(const PbrTile& tile, std::uint32_t lights, std::uint32_t views, float max_tilt) {
  RawMaterial raw;
  raw.lights = spiral_directions(lights, max_tilt);
  raw.views = spiral_directions(views, max_tilt);
  raw.width = tile.width;
  raw.height = tile.height;
  raw.btf.resize(raw.light_rows() * raw.views.size() * raw.texels());
  for (std::size_t v = 0; v < views; ++v) {
    const tensor::Matrix seen = draw_pbr_tile(tile, raw.views[v], raw.lights);
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      for (std::size_t t = 0; t < raw.texels(); ++t)
        raw.btf[(row * views + v) * raw.texels() + t] = seen(Eigen::Index(row), Eigen::Index(t));
  }
  return raw;
}

}  // namespace

TEST_CASE("a ray meets the relief of maps where the first crossing of the curve is") {
  constexpr float lift = 0.05f;
  const PbrTile tile = hills(64, lift);
  const HeightMap relief{tile.width, tile.height, tile.heights};
  for (const Vec3 view : spiral_directions(12, 70))
    for (const float x : {0.1f, 0.4f, 0.77f}) {
      const float slope = view.x / view.z;
      float z = lift;
      while (z > lift * std::cos(turn * (x + slope * z))) z -= 1e-4f;
      // Between texels the curve is off by up to lift (turn / 64)^2 / 8 = 6e-5, which a ray that grazes a
      // crest under 70 degrees multiplies.
      CHECK(first_height(relief, range_of(relief), x, 0.3f, view) == Approx(z).margin(2e-3));
    }
}

TEST_CASE("maps that are fitted to what maps have drawn draw it again in other views under other lights") {
  // A flat tile under a Lambertian share and gloss: no height to find, so that only the search's steps are
  // left.
  const PbrTile flat = hills(12, 0);
  const RawMaterial unseen_flat = drawn(flat, 7, 8, 60);
  CHECK(measure_pbr_tile(unseen_flat, fit_pbr_tile(drawn(flat, 9, 16, 65), true)).se_db() > 30);
  // Heights are found between 49 levels of 0.01, a quarter of the relief; a tile without relief is the rival.
  const PbrTile tile = hills(24, 0.06f);
  const RawMaterial seen = drawn(tile, 7, 20, 65), unseen = drawn(tile, 5, 8, 60);
  const PbrTile fitted = fit_pbr_tile(seen, true);
  PbrTile plain = fitted;
  plain.heights.assign(plain.texels(), 0);
  const double with = measure_pbr_tile(unseen, fitted).se_db(),
               without = measure_pbr_tile(unseen, plain).se_db();
  INFO(with << " dB, without heights " << without);
  CHECK(with > 20);
  CHECK(with > without + 5);
}
