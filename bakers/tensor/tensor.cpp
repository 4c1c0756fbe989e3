#include "bakers/tensor/tensor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

// Sums value(i), i < count, over blocks of a fixed size: eight sums side by side, which the compiler keeps in
// registers, then the blocks in order.
template <class Value>
double block_sum(std::size_t count, const Value& value) {
  constexpr std::size_t block = std::size_t(1) << 18, lanes = 8;
  return ordered_sum(count, block, [&](std::size_t first, std::size_t last) {
    double sum[lanes] = {};
    std::size_t i = first;
    for (; i + lanes <= last; i += lanes)
      for (std::size_t l = 0; l < lanes; ++l) sum[l] += value(i + l);
    for (; i < last; ++i) sum[0] += value(i);
    double total = 0;
    for (double s : sum) total += s;
    return total;
  });
}

void need_same_size(const TensorView& a, const TensorView& b) {
  if (a.dimensions != b.dimensions)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "tensors differ in size (%zu and %zu entries in %zu and %zu modes)", a.size(), b.size(),
                  a.order(), b.order());
}

// Calls body(row, column, entry in memory) for each entry of the unfolding. The paper's order of columns,
// modes behind n before those ahead of it, the first the slowest, is r * outer + o.
template <class Body>
void for_each_unfolded(const ModeLayout& l, const Body& body) {
  for (std::size_t i = 0; i < l.size; ++i)
    for (std::size_t r = 0; r < l.inner; ++r)
      for (std::size_t o = 0; o < l.outer; ++o) body(i, r * l.outer + o, (o * l.size + i) * l.inner + r);
}

std::string indices_of(std::size_t entry, const Dimensions& dimensions) {
  std::string text;
  for (std::size_t n = dimensions.size(); n-- > 0; entry /= dimensions[n])
    text = std::to_string(entry % dimensions[n]) + (text.empty() ? "" : ", ") + text;
  return text;
}

}  // namespace

std::size_t volume(const Dimensions& dimensions) {
  std::size_t product = 1;
  for (std::size_t d : dimensions) product *= d;
  return product;
}

ModeLayout layout_of(const Dimensions& dimensions, std::size_t mode) {
  ModeLayout layout;
  for (std::size_t n = 0; n < mode; ++n) layout.outer *= dimensions[n];
  layout.size = dimensions[mode];
  for (std::size_t n = mode + 1; n < dimensions.size(); ++n) layout.inner *= dimensions[n];
  return layout;
}

double scalar_product(const TensorView& a, const TensorView& b) {
  need_same_size(a, b);
  return block_sum(a.size(), [&](std::size_t i) { return double(a.data[i]) * double(b.data[i]); });
}

double squared_norm(const TensorView& a) {
  return scalar_product(a, a);
}

double squared_distance(const TensorView& a, const TensorView& b) {
  need_same_size(a, b);
  return block_sum(a.size(), [&](std::size_t i) {
    const double difference = double(a.data[i]) - double(b.data[i]);
    return difference * difference;
  });
}

Matrix unfold(const TensorView& a, std::size_t mode) {
  const ModeLayout layout = layout_of(a.dimensions, mode);
  Matrix unfolded(Eigen::Index(layout.size), Eigen::Index(layout.outer * layout.inner));
  for_each_unfolded(layout, [&](std::size_t row, std::size_t column, std::size_t entry) {
    unfolded(Eigen::Index(row), Eigen::Index(column)) = a.data[entry];
  });
  return unfolded;
}

Tensor fold(const Matrix& unfolded, const Dimensions& dimensions, std::size_t mode) {
  Tensor a(dimensions);
  for_each_unfolded(layout_of(dimensions, mode), [&](std::size_t row, std::size_t column, std::size_t entry) {
    a.data[entry] = unfolded(Eigen::Index(row), Eigen::Index(column));
  });
  return a;
}

Tensor sub_tensors(const TensorView& a, std::size_t mode, const std::vector<std::size_t>& indices) {
  const ModeLayout layout = layout_of(a.dimensions, mode);
  Dimensions dimensions = a.dimensions;
  dimensions[mode] = indices.size();
  Tensor joined(dimensions);
  float* out = joined.data.data();
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i : indices)
      out = std::copy_n(a.data + (o * layout.size + i) * layout.inner, layout.inner, out);
  return joined;
}

void check_tensor(const TensorView& a) {
  for (std::size_t n = 0; n < a.order(); ++n)
    if (a.dimensions[n] == 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "mode %zu of the tensor has size 0 (need at least 1)",
                    n + 1);
  if (a.dimensions.empty() || !a.data)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the tensor is empty; entries in at least one mode are needed");
  // A sum with an entry that is not finite is not finite itself; only then is the entry looked for.
  if (std::isfinite(block_sum(a.size(), [&](std::size_t i) { return double(a.data[i]); }))) return;
  const auto bad = std::size_t(
      std::find_if(a.data, a.data + a.size(), [](float v) { return !std::isfinite(v); }) - a.data);
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "entry (%s) of the tensor, counted from 0, is not finite (got %g)",
                indices_of(bad, a.dimensions).c_str(), double(a.data[bad]));
}

}  // namespace nook::bake::tensor
