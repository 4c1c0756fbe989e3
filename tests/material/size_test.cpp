// The sizes of the paper's Table I, in MiB.
#include <array>
#include <cmath>

#include "sdk/src/material/material.h"
#include "tests/catch.h"

using namespace nook::material;

namespace {

struct Row {
  const char* name;
  std::uint32_t lights, views, texels, rank_light, rank_view, rank_xy, clusters;
  bool votf;
  double n_svd, cta, k_cta;  // as printed
};

constexpr std::array<Row, 5> table{{
    {"Corduroy", 81, 81, 128, 20, 32, 80, 8, false, 7.87, 8.13, 8.14},
    {"Fiber", 100, 100, 96, 16, 80, 64, 20, true, 11.07, 12.06, 12.09},
    {"RoughHole", 100, 100, 96, 28, 44, 96, 11, true, 22.26, 22.54, 22.56},
    {"Sponge", 120, 90, 128, 16, 20, 80, 5, false, 3.96, 4.11, 4.11},
    {"Wool", 81, 81, 128, 20, 28, 64, 7, false, 4.42, 4.60, 4.60},
}};

double mebibytes(const Row& row, std::uint32_t clusters, std::uint32_t mixture) {
  Material material;
  material.lights.resize(row.lights);
  material.btf.shape = {row.views,   row.texels,  row.texels, row.rank_light, row.rank_view / clusters,
                        row.rank_xy, row.rank_xy, clusters,   mixture};
  if (row.votf) {
    material.visibility = VisibilityForm::distance;
    // Both VOTFs have R_x = R_y = 80, and the view rank and clusters of their BTF.
    material.votf.shape = {row.views, row.texels, row.texels, 1,      row.rank_view / clusters,
                           80,        80,         clusters,   mixture};
  }
  return double(compressed_bytes(material)) / (1 << 20);
}

}  // namespace

TEST_CASE("sizes of N-SVD agree with the paper's table") {
  for (const Row& row : table) {
    INFO(row.name);
    CHECK(std::round(100 * mebibytes(row, 1, 1)) == std::round(100 * row.n_svd));
  }
}

TEST_CASE("sizes of CTA and K-CTA agree with the paper's table to 0.4 per cent") {
  // The paper does not describe the storage of the membership.
  for (const Row& row : table) {
    INFO(row.name);
    CHECK(std::abs(mebibytes(row, row.clusters, 1) / row.cta - 1) < 0.004);
    CHECK(std::abs(mebibytes(row, row.clusters, 3) / row.k_cta - 1) < 0.004);
  }
}
