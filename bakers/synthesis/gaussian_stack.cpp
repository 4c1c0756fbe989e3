#include "bakers/synthesis/gaussian_stack.h"

#include <tbb/parallel_for.h>

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

}  // namespace nook::bake::synthesis
