#include "bakers/synthesis/similar_texels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nook::bake::synthesis {
namespace {

using tensor::Matrix;

constexpr Eigen::Index block = 256;
// Bounds the comparisons of a large exemplar.
constexpr double max_pairs = 1.5e9;
constexpr Eigen::Index max_candidates = 16384, fewest_candidates = 1024;

Texel texel_of(const ExemplarShape& shape, Eigen::Index row) {
  return {std::int32_t(row % shape.width), std::int32_t(row / shape.width)};
}

Matrix surroundings(const Matrix& appearance, const ExemplarShape& shape, std::int32_t spacing) {
  const Eigen::Index channels = appearance.cols();
  Matrix out(appearance.rows(), 4 * channels);
  tbb::parallel_for(Eigen::Index{0}, appearance.rows(), [&](Eigen::Index row) {
    Eigen::Index at = 0;
    for (const Texel step : {Texel{-1, -1}, Texel{1, -1}, Texel{-1, 1}, Texel{1, 1}}) {
      out.row(row).segment(at, channels) =
          appearance.row(shape.row(shape.inside(texel_of(shape, row) + step * spacing)));
      at += channels;
    }
  });
  return out;
}

// Returns the squared distance of two texels, the shorter way round in an exemplar that tiles.
double squared_distance(const ExemplarShape& shape, Texel a, Texel b) {
  double dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  if (shape.is_tiling) {
    dx = std::min(dx, shape.width - dx);
    dy = std::min(dy, shape.height - dy);
  }
  return dx * dx + dy * dy;
}

}  // namespace

std::vector<Texel> similar_texels(const Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing) {
  const Eigen::Index texels = shape.texels();
  const Matrix all = surroundings(appearance, shape, spacing);
  const Eigen::Index offered =
      std::clamp(Eigen::Index(max_pairs / double(texels)), fewest_candidates, max_candidates);
  const Eigen::Index stride = (texels + offered - 1) / offered, count = (texels + stride - 1) / stride;
  Matrix candidates(count, all.cols());
  std::vector<char> is_offered(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) {
    candidates.row(i) = all.row(i * stride);
    is_offered[std::size_t(i)] = shape.is_shown(texel_of(shape, i * stride));
  }
  const Eigen::RowVectorXf squares = candidates.rowwise().squaredNorm().transpose();
  const double apart = 0.05 * std::min(shape.width, shape.height);
  std::vector<Texel> out(static_cast<std::size_t>(texels));
  tbb::parallel_for(Eigen::Index{0}, (texels + block - 1) / block, [&](Eigen::Index i) {
    const Eigen::Index first = i * block, rows = std::min(block, texels - first);
    // Squared distances up to those of the rows to the origin.
    Matrix distances = -2 * all.middleRows(first, rows) * candidates.transpose();
    distances.rowwise() += squares;
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Texel own = texel_of(shape, first + r);
      float least = std::numeric_limits<float>::infinity();
      Texel best = own;
      for (Eigen::Index c = 0; c < count; ++c) {
        if (distances(r, c) >= least || !is_offered[std::size_t(c)]) continue;
        const Texel other = texel_of(shape, c * stride);
        if (squared_distance(shape, own, other) < apart * apart) continue;
        least = distances(r, c);
        best = other;
      }
      out[std::size_t(first + r)] = best;
    }
  });
  return out;
}

}  // namespace nook::bake::synthesis
