// Reports compare the bytes of files as they are written.
#include "bakers/lab/material/equal_bytes.h"

#include <Eigen/SVD>
#include <cmath>

#include "bakers/lab/material/material_peers.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "tests/bakers/material/small_material.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;
using namespace nook::lab;
namespace nm = nook::material;

namespace {

CompressionSettings settings_of(Method method) {
  CompressionSettings s;
  s.method = method;
  s.rank_light = 8;
  s.rank_view = 8;
  s.rank_x = 8;
  s.rank_y = 12;
  s.votf_rank_x = s.votf_rank_y = 8;
  s.mixture = 2;
  return s;
}

std::vector<std::byte> file_of(const RawMaterial& raw, const CompressionSettings& s) {
  nm::Material material = compress(raw, s);
  material.recipe = describe(s).dump().c_str();
  return nm::write_material(material);
}

}  // namespace

TEST_CASE("a view map has 64 cells a side by default") {
  CHECK(CompressionSettings{}.map_side == 64);
  const RawMaterial raw = test::small_material();
  CHECK(compress(raw, settings_of(Method::k_cta)).btf.map.side == 64);
}

TEST_CASE("rows count whole files, view maps included where none were made") {
  const RawMaterial raw = test::small_material();
  for (const Method method : {Method::n_svd, Method::cta, Method::k_cta}) {
    CompressionSettings s = settings_of(method);
    s.visibility = GENERATE(nm::VisibilityForm::none, nm::VisibilityForm::distance);
    const std::vector<std::byte> file = file_of(raw, s);
    INFO(method_name(method));
    CHECK(measure_method(raw, s).file_bytes == file.size());
    nm::Material made;
    CHECK(measure_method(raw, s, {}, &made).file_bytes == file.size());
    CHECK(measure_material(raw, nm::read_material(file)).file_bytes == file.size());
  }
}

TEST_CASE("the view rank of an N-SVD fills the bytes of a file") {
  const RawMaterial raw = test::small_material();
  CompressionSettings k_cta = settings_of(Method::k_cta);
  k_cta.map_side = 8;
  const std::size_t bytes = file_of(raw, k_cta).size();
  const CompressionSettings s = settings_of(Method::n_svd);
  const std::uint32_t rank = n_svd_view_rank(raw, s, bytes);
  const auto size_at = [&](std::uint32_t rank_view) {
    CompressionSettings at = s;
    at.rank_view = rank_view;
    return nm::write_material(compress(raw, at)).size();
  };
  REQUIRE(rank > 1);
  REQUIRE(rank < raw.views.size());
  CHECK(size_at(rank) <= bytes);
  CHECK(size_at(rank + 1) > bytes);
  CHECK(n_svd_view_rank(raw, s, size_at(5)) == 5);
  CHECK(n_svd_view_rank(raw, s, size_at(5) - 1) == 4);
  CHECK(n_svd_view_rank(raw, s, size_at(1) - 1) == 0);
  CHECK(n_svd_view_rank(raw, s, bytes * 100) == raw.views.size());
}

TEST_CASE("principal components take the place of a file's BTF and leave the rest of it") {
  const RawMaterial raw = test::small_material();
  for (const std::uint32_t map_side : {0u, 32u}) {
    CompressionSettings s = settings_of(Method::k_cta);
    s.map_side = map_side;
    const std::vector<std::byte> file = file_of(raw, s);
    const MethodRow row = measure_pca(raw, file, 1);
    CHECK(row.file_bytes <= file.size());
    const std::size_t component = 2 * (raw.light_rows() * raw.views.size() + raw.texels());
    CHECK(row.file_bytes + component > file.size());  // no other one fits
    // Directions, VOTF, its view map and the recipe are the file's own.
    nm::Material rest = nm::read_material(file);
    CHECK(row.file_bytes - row.bytes > nm::compressed_bytes(rest.votf.shape) + 12 * (6 + 24) +
                                           rest.recipe.size() +
                                           nm::view_rows_bytes(rest.votf.shape, map_side * map_side));
  }
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
