#include "bakers/material/btf_error.h"

#include <Eigen/SVD>
#include <cmath>

#include "bakers/material/compression.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/tile_heights.h"
#include "bakers/measure/material/pbr_tile.h"
#include "bakers/measure/material/pca.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/material/small_material.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;
using nook::material::ClusteredTensor;

namespace {

// Equation (24), summed as it stands.
double decoded_value(const std::vector<float>& light_basis, const ClusteredTensor& t, std::size_t row,
                     std::size_t view, std::size_t x, std::size_t y) {
  const auto& s = t.shape;
  double sum = 0;
  for (std::size_t k = 0; k < s.mixture; ++k) {
    const std::size_t c = t.rows.membership[view * s.mixture + k];
    for (std::size_t a = 0; a < s.rank_light; ++a)
      for (std::size_t b = 0; b < s.rank_view; ++b)
        for (std::size_t p = 0; p < s.rank_x; ++p)
          for (std::size_t q = 0; q < s.rank_y; ++q)
            sum +=
                double(light_basis[row * s.rank_light + a]) *
                double(t.rows.coefficients[(view * s.mixture + k) * s.rank_view + b]) *
                double(t.cores[(((c * s.rank_light + a) * s.rank_view + b) * s.rank_x + p) * s.rank_y + q]) *
                double(t.x_bases[(c * s.width + x) * s.rank_x + p]) *
                double(t.y_bases[(c * s.height + y) * s.rank_y + q]);
  }
  return sum;
}

}  // namespace

TEST_CASE("decoded views are equation (24), and the S/E is its error") {
  const RawMaterial raw = test::small_material(4, 8, 6, 8);
  CompressionSettings s;
  s.rank_light = 4;
  s.rank_view = 8;
  s.rank_x = s.rank_y = 4;
  s.votf_rank_x = s.votf_rank_y = 4;
  s.mixture = 2;
  s.map_side = 0;
  const CompressedBtf btf = compress_btf(raw, s);
  double signal = 0, error = 0;
  for (std::size_t view = 0; view < 8; ++view) {
    const auto image = decode_btf_view(btf.light_basis, btf.tensor, view);
    for (std::size_t row = 0; row < 12; ++row)
      for (std::size_t x = 0; x < 6; ++x)
        for (std::size_t y = 0; y < 8; ++y) {
          const double wanted = decoded_value(btf.light_basis, btf.tensor, row, view, x, y);
          REQUIRE(double(image(Eigen::Index(row), Eigen::Index(x * 8 + y))) == Approx(wanted).margin(1e-4));
          const double truth = double(raw.btf[((row * 8 + view) * 6 + x) * 8 + y]);
          signal += truth * truth;
          error += (truth - wanted) * (truth - wanted);
        }
  }
  const BtfError measured = measure_btf(raw, btf.light_basis, btf.tensor);
  CHECK(measured.se_db() == Approx(10 * std::log10(signal / error)).margin(0.01));
  CHECK(measured.values == raw.btf.size());
}

TEST_CASE("error texels are counted by the threshold of each form") {
  RawMaterial raw = test::small_material(4, 4, 4, 4);
  ClusteredTensor t;
  t.shape = {4, 4, 4, 1, 1, 4, 4, 1, 1};
  t.cores.assign(16, 0.4f);
  t.rows.membership.assign(4, 0);
  t.rows.coefficients = {1, 1, 1, -1};
  std::size_t visible = 0;
  for (std::size_t i = 0; i < 3 * 16; ++i) visible += raw.mask[i] > 0.5f;
  std::size_t last = 0;
  for (std::size_t i = 3 * 16; i < 4 * 16; ++i) last += raw.mask[i] > 0.5f;
  // Decoded: 0.4 in three views, -0.4 in the last. As a mask all is hidden; as a distance the three are
  // visible.
  CHECK(count_error_texels(raw, t, nook::material::VisibilityForm::binary) == visible + last);
  CHECK(count_error_texels(raw, t, nook::material::VisibilityForm::distance) == 48 - visible + last);
}

TEST_CASE("a material of another size is refused") {
  const RawMaterial raw = test::small_material(4, 8, 6, 8), other = test::small_material(4, 8, 8, 8);
  CompressionSettings s;
  s.rank_light = s.rank_view = s.rank_x = s.rank_y = s.votf_rank_x = s.votf_rank_y = 4;
  s.mixture = 1;
  const CompressedBtf btf = compress_btf(raw, s);
  CHECK_THROWS_AS(measure_btf(other, btf.light_basis, btf.tensor), Failure);
}

TEST_CASE("PCA is the best low-rank matrix") {
  const RawMaterial raw = test::small_material(4, 10, 8, 9);
  const Eigen::Map<const tensor::Matrix> data(raw.btf.data(), 120, 72);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(data.cast<double>());
  const std::size_t component_bytes = 2 * (120 + 72);
  for (const Eigen::Index rank : {2, 5}) {
    const PcaResult pca = fit_pca(raw, std::size_t(rank) * component_bytes + 7, 1);
    CHECK(pca.components == std::size_t(rank));
    CHECK(pca.bytes == std::size_t(rank) * component_bytes);
    const Eigen::VectorXd square = svd.singularValues().array().square();
    const double best = 10 * std::log10(square.sum() / square.tail(square.size() - rank).sum());
    // Half floats cost less than that at these errors.
    CHECK(pca.se_db == Approx(best).margin(0.02));
  }
  CHECK_THROWS_AS(fit_pca(raw, component_bytes - 1, 1), Failure);
}

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
