#include "bakers/material/btf_error.h"

#include "bakers/material/compression.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/tile_heights.h"
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
