#include "bakers/tensor/tensor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

// Returns the sum of value(i) for i < count, computed in blocks of a fixed size. Each block has eight
// parallel sums, which the compiler keeps in registers. Blocks are added in order.
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

// Calls body(row, column, index in memory) for each entry of the unfolding. In the paper's order of columns,
// the indices of the modes after n change slowest, and the indices of the modes before n change fastest. So
// the column is r * outer + o.
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
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the tensor is empty; need entries in at least one mode");
  // The sum is not finite if an entry is not finite. Only then do we search for the entry.
  if (std::isfinite(block_sum(a.size(), [&](std::size_t i) { return double(a.data[i]); }))) return;
  const auto bad = std::size_t(
      std::find_if(a.data, a.data + a.size(), [](float v) { return !std::isfinite(v); }) - a.data);
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "entry (%s) of the tensor, counted from 0, is not finite (got %g)",
                indices_of(bad, a.dimensions).c_str(), double(a.data[bad]));
}

namespace {

using Eigen::Index;
using Rows = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
using RowsOut = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;

// Computes out = in x_mode U for one tensor, on the calling thread.
void multiply(const float* in, const ModeLayout& layout, const Matrix& u, float* out) {
  const Index size = Index(layout.size), rows = u.rows(), inner = Index(layout.inner);
  if (inner == 1) {
    Eigen::Map<Matrix>(out, Index(layout.outer), rows).noalias() =
        Eigen::Map<const Matrix>(in, Index(layout.outer), size) * u.transpose();
    return;
  }
  for (std::size_t o = 0; o < layout.outer; ++o)
    Eigen::Map<Matrix>(out + Index(o) * rows * inner, rows, inner).noalias() =
        u * Eigen::Map<const Matrix>(in + Index(o) * size * inner, size, inner);
}

// Multiplies the tensor `in` by the matrix U along its first mode. Blocks of columns run in parallel.
void multiply_first(const float* in, const ModeLayout& layout, const Matrix& u, float* out) {
  const auto stride = Eigen::OuterStride<>(Index(layout.inner));
  constexpr std::size_t block = 1024;
  for_each_block(layout.inner, block, [&](std::size_t first, std::size_t last) {
    const Index columns = Index(last - first);
    RowsOut(out + first, u.rows(), columns, stride).noalias() =
        u * Rows(in + first, Index(layout.size), columns, stride);
  });
}

void need_fit(const TensorView& a, std::size_t mode, const Matrix& u) {
  if (mode >= a.order() || std::size_t(u.cols()) != a.dimensions[mode])
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a matrix of %zu columns does not fit mode %zu of a tensor of order %zu",
                  std::size_t(u.cols()), mode + 1, a.order());
}

double growth(const Matrix& u) {
  return u.size() == 0 ? 1 : double(u.rows()) / double(u.cols());
}

// Returns the modes after the first that have a matrix. The mode that shrinks most comes first.
std::vector<std::size_t> inner_order(const std::vector<Matrix>& u) {
  std::vector<std::size_t> order;
  for (std::size_t n = 1; n < u.size(); ++n)
    if (u[n].size() > 0) order.push_back(n);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return growth(u[a]) < growth(u[b]); });
  return order;
}

// For each sub-tensor of the first mode, multiplies all other modes in the given order.
Tensor inner_products(const TensorView& a, const std::vector<Matrix>& u,
                      const std::vector<std::size_t>& order) {
  Dimensions result = a.dimensions;
  for (std::size_t n : order) result[n] = std::size_t(u[n].rows());
  Tensor product(result);
  const std::size_t slab_in = a.size() / a.dimensions[0], slab_out = product.data.size() / a.dimensions[0];
  tbb::parallel_for(std::size_t(0), a.dimensions[0], [&](std::size_t i) {
    Dimensions now = a.dimensions;
    now[0] = 1;
    const float* in = a.data + i * slab_in;
    std::vector<float> held, next;
    for (std::size_t step = 0; step < order.size(); ++step) {
      const std::size_t n = order[step];
      const ModeLayout layout = layout_of(now, n);
      now[n] = std::size_t(u[n].rows());
      const bool last = step + 1 == order.size();
      if (!last) next.resize(volume(now));
      multiply(in, layout, u[n], last ? product.data.data() + i * slab_out : next.data());
      held.swap(next);
      in = held.data();
    }
  });
  return product;
}

}  // namespace

Tensor mode_product(const TensorView& a, std::size_t mode, const Matrix& u) {
  std::vector<Matrix> all(a.order());
  need_fit(a, mode, u);
  all[mode] = u;
  return mode_products(a, all);
}

Tensor mode_products(const TensorView& a, const std::vector<Matrix>& u) {
  if (u.size() != a.order())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "got %zu matrices for a tensor of order %zu; need one for each mode", u.size(), a.order());
  for (std::size_t n = 0; n < u.size(); ++n)
    if (u[n].size() > 0) need_fit(a, n, u[n]);
  const std::vector<std::size_t> order = inner_order(u);
  const bool has_first = u[0].size() > 0;
  const auto first_product = [&](const TensorView& from) {
    Dimensions result = from.dimensions;
    result[0] = std::size_t(u[0].rows());
    Tensor product(result);
    multiply_first(from.data, layout_of(from.dimensions, 0), u[0], product.data.data());
    return product;
  };
  if (order.empty()) {
    if (has_first) return first_product(a);
    Tensor copy(a.dimensions);
    std::copy_n(a.data, a.size(), copy.data.begin());
    return copy;
  }
  if (!has_first) return inner_products(a, u, order);
  if (growth(u[0]) <= growth(u[order.front()])) return inner_products(first_product(a), u, order);
  return first_product(inner_products(a, u, order));
}

Tensor project(const TensorView& a, const std::vector<Matrix>& bases) {
  std::vector<Matrix> transposed(bases.size());
  for (std::size_t n = 0; n < bases.size(); ++n) transposed[n] = bases[n].transpose();
  return mode_products(a, transposed);
}

}  // namespace nook::bake::tensor
