#include "bakers/tensor/gram.h"

#include <algorithm>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Rows = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;

// The number of columns of an unfolding that are summed in floats. The error of such a sum is about 1e-7
// times the square root of this number, which is below the rounding error of the data.
constexpr std::size_t float_columns = 512;
// The maximum number of parts of a sum. Each part is a task with its own sum.
constexpr std::size_t most_parts = 32;

// Accesses the unfolding of mode n in pieces: matrices of I_n x columns, one after another.
struct Pieces {
  explicit Pieces(const ModeLayout& mode_layout) : layout(mode_layout) {
    if (layout.inner == 1) {
      per_outer = 0;
      count = (layout.outer + float_columns - 1) / float_columns;
    } else {
      per_outer = (layout.inner + float_columns - 1) / float_columns;
      count = layout.outer * per_outer;
    }
  }
  // Calls `body` with piece p of `data`. `size` is the size of mode n in `data`.
  template <class Body>
  void with(const float* data, std::size_t size, std::size_t p, const Body& body) const {
    if (layout.inner == 1) {
      const std::size_t first = p * float_columns;
      const std::size_t columns = std::min(float_columns, layout.outer - first);
      body(Eigen::Map<const Matrix>(data + first * size, Index(columns), Index(size)).transpose());
    } else {
      const std::size_t o = p / per_outer, first = p % per_outer * float_columns;
      const std::size_t columns = std::min(float_columns, layout.inner - first);
      body(Rows(data + o * size * layout.inner + first, Index(size), Index(columns),
                Eigen::OuterStride<>(Index(layout.inner))));
    }
  }

  ModeLayout layout;
  std::size_t per_outer = 0, count = 0;
};

// Calls add(piece, sum) for all pieces, and returns the sum. The division into parts does not depend on the
// number of threads.
template <class Add>
MatrixXd sum_over(const Pieces& pieces, std::size_t rows, std::size_t columns, const Add& add) {
  const std::size_t part = (pieces.count + most_parts - 1) / most_parts;
  std::vector<MatrixXd> sums((pieces.count + part - 1) / part);
  for_each_block(pieces.count, part, [&](std::size_t first, std::size_t last) {
    MatrixXd& sum = sums[first / part];
    sum = MatrixXd::Zero(Index(rows), Index(columns));
    for (std::size_t p = first; p < last; ++p) add(p, sum);
  });
  for (std::size_t s = 1; s < sums.size(); ++s) sums[0] += sums[s];
  return sums[0];
}

}  // namespace

MatrixXd cross_gram(const TensorView& a, const TensorView& b, std::size_t mode) {
  const ModeLayout left = layout_of(a.dimensions, mode), right = layout_of(b.dimensions, mode);
  if (left.outer != right.outer || left.inner != right.inner)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "sub-tensors of mode %zu differ in size (%zu and %zu entries)",
                  mode + 1, left.outer * left.inner, right.outer * right.inner);
  const Pieces pieces(left);
  return sum_over(pieces, left.size, right.size, [&](std::size_t p, MatrixXd& sum) {
    pieces.with(a.data, left.size, p, [&](const auto& x) {
      pieces.with(b.data, right.size, p, [&](const auto& y) {
        const Eigen::MatrixXf product = x * y.transpose();
        sum += product.cast<double>();
      });
    });
  });
}

MatrixXd gram(const TensorView& a, std::size_t mode) {
  const ModeLayout layout = layout_of(a.dimensions, mode);
  const Pieces pieces(layout);
  MatrixXd sum = sum_over(pieces, layout.size, layout.size, [&](std::size_t p, MatrixXd& lower) {
    pieces.with(a.data, layout.size, p, [&](const auto& x) {
      Eigen::MatrixXf product = Eigen::MatrixXf::Zero(x.rows(), x.rows());
      product.template selfadjointView<Eigen::Lower>().rankUpdate(x);
      lower.template triangularView<Eigen::Lower>() += product.cast<double>();
    });
  });
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  return sum;
}

Matrix leading_eigenvectors(const MatrixXd& symmetric, std::size_t count) {
  MatrixXd vectors = symmetric_eigen(symmetric).vectors.rightCols(Index(count)).rowwise().reverse();
  for (Index c = 0; c < vectors.cols(); ++c) {
    Index greatest = 0;
    vectors.col(c).cwiseAbs().maxCoeff(&greatest);
    if (vectors(greatest, c) < 0) vectors.col(c) *= -1;
  }
  return vectors.cast<float>();
}

PrincipalComponents principal_components(const Matrix& samples, std::size_t count) {
  PrincipalComponents out;
  out.mean = samples.cast<double>().colwise().mean().cast<float>();
  const Matrix centred = samples.rowwise() - out.mean;
  Eigen::MatrixXf covariance = Eigen::MatrixXf::Zero(samples.cols(), samples.cols());
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(centred.transpose());
  const SymmetricEigen eigen = symmetric_eigen(covariance.cast<double>());
  const Eigen::Index kept = std::min(Eigen::Index(count), samples.cols());
  out.basis = eigen.vectors.rightCols(kept).rowwise().reverse().cast<float>();
  return out;
}

Matrix project(const Matrix& samples, const PrincipalComponents& components) {
  return (samples.rowwise() - components.mean) * components.basis;
}

std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple) {
  check_tensor(a);
  if (share.size() != a.order() || multiple < 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "got %zu shares and a multiple of %zu for a tensor of order %zu; need one share for each "
                  "mode and a multiple of 1 or more",
                  share.size(), multiple, a.order());
  std::vector<std::size_t> ranks(a.order());
  for (std::size_t n = 0; n < a.order(); ++n) {
    // At rank r, the loss is the sum of all eigenvalues except the r largest. Eigenvalues are in ascending
    // order.
    const Eigen::VectorXd energy = symmetric_eigenvalues(gram(a, n)).cwiseMax(0.0);
    const double allowed = share[n] * energy.sum();
    double lost = 0;
    std::size_t rank = a.dimensions[n];
    while (rank > 1 && lost + energy[energy.size() - Eigen::Index(rank)] <= allowed) {
      lost += energy[energy.size() - Eigen::Index(rank)];
      --rank;
    }
    ranks[n] = std::min(a.dimensions[n], (rank + multiple - 1) / multiple * multiple);
  }
  return ranks;
}

}  // namespace nook::bake::tensor
