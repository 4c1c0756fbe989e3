// The sizes of a clustered tensor and what it costs to store. Y.-T. Tsai, Z.-C. Shih: K-Clustered Tensor
// Approximation, 2012; I, R, C and K are the paper's symbols.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::material {

// N-SVD has clusters = mixture = 1, CTA mixture = 1, K-CTA any.
struct TensorShape {
  std::uint32_t views = 0;       // I_v
  std::uint32_t width = 0;       // I_x, texels along u
  std::uint32_t height = 0;      // I_y, texels along v
  std::uint32_t rank_light = 1;  // R_l; 1 of a VOTF, which has no light mode
  std::uint32_t rank_view = 0;   // R_v, of each cluster
  std::uint32_t rank_x = 0;      // R_x, at most I_x
  std::uint32_t rank_y = 0;      // R_y, at most I_y
  std::uint32_t clusters = 1;    // C
  std::uint32_t mixture = 1;     // K, clusters that a view is mixed from; at most C

  bool operator==(const TensorShape&) const = default;
};

// Numbers in one core tensor Z_c, R_l R_v R_x R_y.
constexpr std::size_t core_size(const TensorShape& s) {
  return std::size_t(s.rank_light) * s.rank_view * s.rank_x * s.rank_y;
}
// Numbers in one cluster's basis of a spatial mode; none at full rank, where the basis is the identity.
constexpr std::size_t x_basis_size(const TensorShape& s) {
  return s.rank_x < s.width ? std::size_t(s.width) * s.rank_x : 0;
}
constexpr std::size_t y_basis_size(const TensorShape& s) {
  return s.rank_y < s.height ? std::size_t(s.height) * s.rank_y : 0;
}
// Non-zero mixing coefficients of `rows` rows of the view bases, K R_v each.
constexpr std::size_t coefficient_count(const TensorShape& s, std::size_t rows) {
  return rows * s.mixture * s.rank_view;
}

// Bytes of `rows` rows of the view bases: coefficients as half floats, cluster indices in one byte, or two
// above 256 clusters; no index where there is but one cluster.
constexpr std::size_t view_rows_bytes(const TensorShape& s, std::size_t rows) {
  const std::size_t index_bytes = s.clusters == 1 ? 0 : s.clusters <= 256 ? 1 : 2;
  return 2 * coefficient_count(s, rows) + index_bytes * rows * s.mixture;
}

// Bytes of core tensors, spatial bases and the views' rows as half floats: the measure of the paper's Table I
// (there in MiB). A resampled view map comes on top, view_rows_bytes(shape, side * side).
constexpr std::size_t compressed_bytes(const TensorShape& s) {
  return 2 * s.clusters * (core_size(s) + x_basis_size(s) + y_basis_size(s)) + view_rows_bytes(s, s.views);
}
// Bytes of the global light basis; red, green and blue are rows of it.
constexpr std::size_t light_basis_bytes(std::size_t lights, const TensorShape& s) {
  return 2 * 3 * lights * s.rank_light;
}

}  // namespace nook::material
