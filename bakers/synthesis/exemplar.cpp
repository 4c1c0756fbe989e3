#include "bakers/synthesis/exemplar.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "bakers/tensor/gram.h"

namespace nook::bake::synthesis {
namespace {

using tensor::Matrix;

Matrix filtered(const Matrix& values, const ExemplarShape& shape, Texel step) {
  constexpr float weights[] = {1 / 16.0f, 4 / 16.0f, 6 / 16.0f, 4 / 16.0f, 1 / 16.0f};
  Matrix out = Matrix::Zero(values.rows(), values.cols());
  tbb::parallel_for(0, shape.height, [&](std::int32_t y) {
    for (std::int32_t x = 0; x < shape.width; ++x)
      for (std::int32_t i = 0; i < 5; ++i)
        out.row(shape.row({x, y})) +=
            weights[i] * values.row(shape.row(shape.inside(Texel{x, y} + step * (i - 2))));
  });
  return out;
}

}  // namespace

std::vector<Matrix> gaussian_stack(const Exemplar& exemplar, std::uint32_t levels) {
  std::vector<Matrix> stack{exemplar.values};
  for (std::uint32_t level = 0; level < levels; ++level) {
    const std::int32_t spacing = 1 << level;
    stack.push_back(
        filtered(filtered(stack.back(), exemplar.shape, {spacing, 0}), exemplar.shape, {0, spacing}));
  }
  return stack;
}

namespace {

using tensor::Matrix;

constexpr std::int32_t reach = 2;  // texels of a window on each side of its middle
constexpr Eigen::Index window_texels = (2 * reach + 1) * (2 * reach + 1);
constexpr Eigen::Index most_samples = 16384;  // windows that define the principal components
constexpr Eigen::Index block = 1024;

// Returns the windows of `count` texels: first, first + stride, ...
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

Exemplar balanced(const Exemplar& exemplar) {
  Exemplar out = exemplar;
  const Eigen::RowVectorXf mean = out.values.cast<double>().colwise().mean().cast<float>();
  out.values.rowwise() -= mean;
  const double before = out.values.cast<double>().squaredNorm();
  for (Eigen::Index channel = 0; channel < out.values.cols(); ++channel) {
    const double deviation =
        std::sqrt(out.values.col(channel).cast<double>().squaredNorm() / double(out.values.rows()));
    if (deviation > 0) out.values.col(channel) *= float(1 / std::sqrt(deviation));
  }
  const double after = out.values.cast<double>().squaredNorm();
  if (after > 0) out.values *= float(std::sqrt(before / after));
  return out;
}

}  // namespace nook::bake::synthesis
