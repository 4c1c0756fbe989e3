#include "sdk/src/material/spatial_modes.h"

#include <algorithm>
#include <cmath>

namespace nook::material {
namespace {

Vector<float> transposed(std::span<const float> matrix, std::size_t rows, std::size_t columns,
                         Memory* memory) {
  Vector<float> out(matrix.size(), memory);
  if (matrix.empty()) return out;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) out[c * rows + r] = matrix[r * columns + c];
  return out;
}

// Returns the largest norm of a column. If `rows` is empty, it represents the identity, and the result is 1.
double largest_norm(const Vector<float>& rows, std::size_t columns) {
  double largest = rows.empty() ? 1 : 0;
  for (std::size_t c = 0; c < columns && !rows.empty(); ++c) {
    double square = 0;
    for (std::size_t at = c; at < rows.size(); at += columns) square += double(rows[at]) * rows[at];
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

// Returns, along one axis, which fraction of a texel of the smaller level is covered by a texel of the larger
// level.
double share(std::uint32_t texel, std::uint32_t smaller_texel, std::uint32_t size,
             std::uint32_t smaller_size) {
  const double step = double(size) / smaller_size, begin = smaller_texel * step;
  return std::max(0.0, std::min(begin + step, texel + 1.0) - std::max(begin, double(texel))) / step;
}

void add_scaled(const float* row, float scale, std::size_t count, float* out) {
  for (std::size_t c = 0; c < count; ++c) out[c] += scale * row[c];
}

}  // namespace

ModeExpansion::ModeExpansion(const ClusteredTensor& tensor, std::uint32_t cluster, Memory* memory)
    : tensor_(tensor), cluster_(cluster), x_rows_(memory), y_rows_(memory) {
  const TensorShape& s = tensor.shape;
  const std::size_t x = x_basis_size(s), y = y_basis_size(s);
  x_rows_ = transposed({tensor.x_bases.data() + cluster * x, x}, s.width, s.rank_x, memory);
  y_rows_ = transposed({tensor.y_bases.data() + cluster * y, y}, s.height, s.rank_y, memory);
}

const float* ModeExpansion::core(std::uint32_t a, std::uint32_t b) const {
  const TensorShape& s = tensor_.shape;
  const std::size_t slice = std::size_t(s.rank_x) * s.rank_y;
  return tensor_.cores.data() + cluster_ * core_size(s) + (std::size_t(a) * s.rank_view + b) * slice;
}

std::size_t ModeExpansion::scratch_size() const {
  return std::size_t(tensor_.shape.rank_x) * tensor_.shape.height;
}

void ModeExpansion::expand(std::uint32_t a, std::uint32_t b, std::span<float> scratch,
                           std::span<float> image) const {
  const TensorShape& s = tensor_.shape;
  const float* const z = core(a, b);
  // Expands the y mode first: scratch[p, y] = sum_q Z[p, q] Y[y, q].
  std::fill(scratch.begin(), scratch.end(), 0.0f);
  std::fill(image.begin(), image.end(), 0.0f);
  for (std::size_t p = 0; p < s.rank_x; ++p)
    for (std::size_t q = 0; q < s.rank_y; ++q) {
      const float value = z[p * s.rank_y + q];
      if (y_rows_.empty())
        scratch[p * s.height + q] = value;
      else
        add_scaled(&y_rows_[q * s.height], value, s.height, &scratch[p * s.height]);
    }
  for (std::size_t y = 0; y < s.height; ++y)
    for (std::size_t p = 0; p < s.rank_x; ++p) {
      const float value = scratch[p * s.height + y];
      if (x_rows_.empty())
        image[y * s.width + p] = value;
      else
        add_scaled(&x_rows_[p * s.width], value, s.width, &image[y * s.width]);
    }
}

float ModeExpansion::bound() const {
  const TensorShape& s = tensor_.shape;
  double largest = 0;
  for (std::uint32_t a = 0; a < s.rank_light; ++a)
    for (std::uint32_t b = 0; b < s.rank_view; ++b) {
      const float* const z = core(a, b);
      double square = 0;
      for (std::size_t i = 0; i < std::size_t(s.rank_x) * s.rank_y; ++i) square += double(z[i]) * z[i];
      largest = std::max(largest, square);
    }
  return float(std::sqrt(largest) * largest_norm(x_rows_, s.width) * largest_norm(y_rows_, s.height));
}

std::uint32_t level_size(std::uint32_t size, std::uint32_t level) {
  return std::max(size >> level, 1u);
}

std::uint32_t level_count(std::uint32_t width, std::uint32_t height) {
  std::uint32_t levels = 1;
  while (std::max(width, height) >> levels) ++levels;
  return levels;
}

void halve(std::span<const float> image, std::uint32_t width, std::uint32_t height,
           std::span<float> smaller) {
  const std::uint32_t w = level_size(width, 1), h = level_size(height, 1);
  for (std::uint32_t y = 0; y < h; ++y)
    for (std::uint32_t x = 0; x < w; ++x) {
      // The area of the new texel covers at most three texels along each axis, starting at u0.
      const auto u0 = std::uint32_t(std::uint64_t(x) * width / w);
      const auto v0 = std::uint32_t(std::uint64_t(y) * height / h);
      const float* const corner = &image[std::size_t(v0) * width + u0];
      float& out = smaller[std::size_t(y) * w + x];
      if (width == 2 * w && height == 2 * h) {
        out = 0.25f * (corner[0] + corner[1] + corner[width] + corner[width + 1]);
        continue;
      }
      double sum = 0;
      for (std::uint32_t v = v0; v < std::min(v0 + 4, height); ++v)
        for (std::uint32_t u = u0; u < std::min(u0 + 4, width); ++u)
          sum += share(u, x, width, w) * share(v, y, height, h) * image[std::size_t(v) * width + u];
      out = float(sum);
    }
}

}  // namespace nook::material
