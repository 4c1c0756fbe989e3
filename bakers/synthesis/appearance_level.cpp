#include "bakers/synthesis/appearance_level.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "bakers/tensor/gram.h"

namespace nook::bake::synthesis {
namespace {

using tensor::Matrix;

constexpr std::int32_t reach = 2;  // texels of a window on each side of its middle
constexpr Eigen::Index window_texels = (2 * reach + 1) * (2 * reach + 1);
constexpr Eigen::Index most_samples = 16384;  // windows that the components are taken from
constexpr Eigen::Index block = 1024;

// Returns the windows of the texels first, first + stride, ...
Matrix windows(const Matrix& values, const ExemplarShape& shape, std::int32_t spacing, Eigen::Index first,
               Eigen::Index stride, Eigen::Index count) {
  Matrix out(count, window_texels * values.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index texel = first + i * stride;
    const Texel middle{std::int32_t(texel % shape.width), std::int32_t(texel / shape.width)};
    Eigen::Index at = 0;
    for (std::int32_t y = -reach; y <= reach; ++y)
      for (std::int32_t x = -reach; x <= reach; ++x, at += values.cols())
        out.row(i).segment(at, values.cols()) =
            values.row(shape.row(shape.inside(middle + Texel{x, y} * spacing)));
  }
  return out;
}

}  // namespace

Matrix appearance_vectors(const Matrix& values, const ExemplarShape& shape, std::int32_t spacing) {
  const Eigen::Index texels = shape.texels(), stride = (texels + most_samples - 1) / most_samples;
  const auto components = tensor::principal_components(
      windows(values, shape, spacing, 0, stride, (texels + stride - 1) / stride), appearance_channels);
  Matrix out(texels, components.basis.cols());
  tbb::parallel_for(Eigen::Index{0}, (texels + block - 1) / block, [&](Eigen::Index i) {
    const Eigen::Index first = i * block, count = std::min(block, texels - first);
    out.middleRows(first, count) =
        tensor::project(windows(values, shape, spacing, first, 1, count), components);
  });
  return out;
}

}  // namespace nook::bake::synthesis
