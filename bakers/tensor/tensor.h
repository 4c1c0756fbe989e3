// Dense tensors of any order, in floats.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace nook::bake::tensor {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Dimensions = std::vector<std::size_t>;  // I_1 to I_N; modes are counted from 0 in code

std::size_t volume(const Dimensions& dimensions);

// A view of entries, for example of a Tensor. The order is row-major: the index of the last mode changes
// fastest.
struct TensorView {
  Dimensions dimensions;
  const float* data = nullptr;

  std::size_t order() const { return dimensions.size(); }
  std::size_t size() const { return volume(dimensions); }
};

struct Tensor {
  Tensor() = default;
  explicit Tensor(Dimensions sizes) : dimensions(std::move(sizes)), data(volume(dimensions)) {}

  Dimensions dimensions;
  std::vector<float> data;

  operator TensorView() const { return {dimensions, data.data()}; }
};

// The layout of a mode in memory. Entry (o, i, r) is at (o * size + i) * inner + r, with o < outer and r <
// inner.
struct ModeLayout {
  std::size_t outer = 1, size = 1, inner = 1;
};
ModeLayout layout_of(const Dimensions& dimensions, std::size_t mode);

// Returns <A, B> of equation (1), or the squared norm <A, A>. Sums are in doubles, in an order that depends
// only on the size.
double scalar_product(const TensorView& a, const TensorView& b);
double squared_norm(const TensorView& a);
// Returns the squared norm of A - B.
double squared_distance(const TensorView& a, const TensorView& b);

// Returns uf_n(A), I_n x (I_{n+1} ... I_N I_1 ... I_{n-1}), in the paper's order of columns (De Lathauwer
// 2000). Along the columns, the index of mode n + 1 changes slowest, and the index of mode n - 1 fastest.
Matrix unfold(const TensorView& a, std::size_t mode);
// Undoes unfold(): returns the tensor of these dimensions.
Tensor fold(const Matrix& unfolded, const Dimensions& dimensions, std::size_t mode);

// Returns the sub-tensors A_<m_i> of equation (4) for the given indices i, joined along mode m in this order.
Tensor sub_tensors(const TensorView& a, std::size_t mode, const std::vector<std::size_t>& indices);

// Throws INVALID_ARGUMENT for an order of 0, a mode of size 0, no data, or an entry that is not finite. The
// message names the entry's indices.
void check_tensor(const TensorView& a);

// Mode products, equations (2) and (3).

// Returns A x_n U, where U is J_n x I_n.
Tensor mode_product(const TensorView& a, std::size_t mode, const Matrix& u);

// Returns A x_1 U_1 ... x_N U_N. An empty matrix means the identity. Multiplies the modes that shrink most
// first. Computes all modes except the first for one slab of the first mode at a time, so that no
// intermediate tensor is stored as a whole.
Tensor mode_products(const TensorView& a, const std::vector<Matrix>& u);

// Projects onto bases: returns A x_1 U_1^T ... x_N U_N^T.
Tensor project(const TensorView& a, const std::vector<Matrix>& bases);

}  // namespace nook::bake::tensor
