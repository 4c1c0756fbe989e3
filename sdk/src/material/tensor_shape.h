// The sizes of a clustered tensor and of its storage. I, R, C and K are symbols from Y.-T. Tsai, Z.-C. Shih:
// K-Clustered Tensor Approximation, 2012.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::material {

// In N-SVD, `clusters` and `mixture` are 1. In CTA, `mixture` is 1. In K-CTA, both can have any value.
struct TensorShape {
  std::uint32_t views = 0;       // I_v
  std::uint32_t width = 0;       // I_x, texels along u
  std::uint32_t height = 0;      // I_y, texels along v
  std::uint32_t rank_light = 1;  // R_l; 1 for a VOTF, which has no light mode
  std::uint32_t rank_view = 0;   // R_v, of each cluster
  std::uint32_t rank_x = 0;      // R_x, at most I_x
  std::uint32_t rank_y = 0;      // R_y, at most I_y
  std::uint32_t clusters = 1;    // C
  std::uint32_t mixture = 1;     // K, the number of clusters that a view mixes; at most C

  bool operator==(const TensorShape&) const = default;
};

// Returns the number of entries of one core tensor Z_c, R_l R_v R_x R_y.
constexpr std::size_t core_size(const TensorShape& s) {
  return std::size_t(s.rank_light) * s.rank_view * s.rank_x * s.rank_y;
}
// Returns the number of entries of a core's last two modes, R_x R_y.
constexpr std::size_t core_slab(const TensorShape& s) {
  return std::size_t(s.rank_x) * s.rank_y;
}
// Returns the number of entries of one cluster's basis of a spatial mode. At full rank it is 0, because the
// basis is the identity.
constexpr std::size_t x_basis_size(const TensorShape& s) {
  return s.rank_x < s.width ? std::size_t(s.width) * s.rank_x : 0;
}
constexpr std::size_t y_basis_size(const TensorShape& s) {
  return s.rank_y < s.height ? std::size_t(s.height) * s.rank_y : 0;
}
// Returns the number of non-zero mixing coefficients in `rows` rows of the view bases. Each row has K R_v.
constexpr std::size_t coefficient_count(const TensorShape& s, std::size_t rows) {
  return rows * s.mixture * s.rank_view;
}

// Returns the bytes of `rows` rows of the view bases: coefficients as half floats or 8-bit integers, and
// cluster indices in one byte, or two above 256 clusters. With a single cluster there are no indices.
constexpr std::size_t view_rows_bytes(const TensorShape& s, std::size_t rows, std::uint32_t bits = 16) {
  const std::size_t index_bytes = s.clusters == 1 ? 0 : s.clusters <= 256 ? 1 : 2;
  return bits / 8 * coefficient_count(s, rows) + index_bytes * rows * s.mixture;
}

// Returns the bytes of core tensors, spatial bases and the rows of the views. For half floats, this is the
// size in Table I of the paper (there in MiB). A resampled view map takes another view_rows_bytes(shape, side
// * side, bits).
constexpr std::size_t compressed_bytes(const TensorShape& s, std::uint32_t bits = 16) {
  return bits / 8 * s.clusters * (core_size(s) + x_basis_size(s) + y_basis_size(s)) +
         view_rows_bytes(s, s.views, bits);
}
// Returns the bytes of the light basis, which all clusters share. Each light has three rows: red, green and
// blue.
constexpr std::size_t light_basis_bytes(std::size_t lights, const TensorShape& s, std::uint32_t bits = 16) {
  return bits / 8 * 3 * lights * s.rank_light;
}

}  // namespace nook::material
