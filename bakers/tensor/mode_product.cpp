#include "bakers/tensor/mode_product.h"

#include <algorithm>
#include <numeric>

#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;
using Rows = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
using RowsOut = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;

// out = in x_mode U for one tensor, on the calling thread.
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

// out = in x_0 U: the columns in blocks, in parallel.
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

// The modes from 1 on that have a matrix, the most shrinking first.
std::vector<std::size_t> inner_order(const std::vector<Matrix>& u) {
  std::vector<std::size_t> order;
  for (std::size_t n = 1; n < u.size(); ++n)
    if (u[n].size() > 0) order.push_back(n);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return growth(u[a]) < growth(u[b]); });
  return order;
}

// All modes but the first, in the given order, for each sub-tensor of the first.
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
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%zu matrices for a tensor of order %zu", u.size(), a.order());
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
