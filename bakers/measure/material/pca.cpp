#include "bakers/measure/material/pca.h"

#include <Eigen/QR>
#include <algorithm>

#include "bakers/raytrace/hemisphere.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using tensor::Matrix;
using DataMap = Eigen::Map<const Matrix>;

constexpr std::size_t block = 512;  // rows
// Twice the squared error of the last components goes down by their spectrum's ratio at each: beyond this the
// S/E moves by less than 0.01 dB on the built-in materials.
constexpr int iterations = 6;

// A B, in blocks of A's rows.
Matrix times(const DataMap& a, const Matrix& b) {
  Matrix product(a.rows(), b.cols());
  tensor::for_each_block(std::size_t(a.rows()), block, [&](std::size_t first, std::size_t last) {
    product.middleRows(Index(first), Index(last - first)).noalias() =
        a.middleRows(Index(first), Index(last - first)) * b;
  });
  return product;
}

// A^T B, in blocks of A's columns.
Matrix transposed_times(const DataMap& a, const Matrix& b) {
  Matrix product(a.cols(), b.cols());
  tensor::for_each_block(std::size_t(a.cols()), block, [&](std::size_t first, std::size_t last) {
    product.middleRows(Index(first), Index(last - first)).noalias() =
        a.middleCols(Index(first), Index(last - first)).transpose() * b;
  });
  return product;
}

Matrix orthonormal(const Matrix& columns) {
  const Eigen::HouseholderQR<Matrix> qr(columns);
  return qr.householderQ() * Matrix::Identity(columns.rows(), columns.cols());
}

void round_all(Matrix& m) {
  for (Index i = 0; i < m.size(); ++i) m.data()[i] = from_half(to_half(m.data()[i]));
}

}  // namespace

PcaResult fit_pca(const RawMaterial& raw, std::size_t bytes, std::uint64_t seed) {
  const DataMap data(raw.btf.data(), Index(raw.light_rows() * raw.views.size()), Index(raw.texels()));
  PcaResult result;
  const std::size_t component_bytes = 2 * std::size_t(data.rows() + data.cols());
  result.components = std::min({bytes / component_bytes, std::size_t(data.rows()), std::size_t(data.cols())});
  if (result.components == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%zu bytes hold no principal component of %zu bytes", bytes,
                  component_bytes);
  result.bytes = result.components * component_bytes;

  Matrix basis(data.cols(), Index(result.components));
  for (Index i = 0; i < basis.size(); ++i)
    basis.data()[i] = unit_float(mix_bits(mix_bits(seed) + std::uint64_t(i))) - 0.5f;
  basis = orthonormal(basis);
  for (int i = 0; i < iterations; ++i) basis = orthonormal(transposed_times(data, times(data, basis)));
  Matrix weights = times(data, basis);
  round_all(basis);
  round_all(weights);

  const auto square = [&](auto&& part) {
    return tensor::ordered_sum(std::size_t(data.rows()), block, [&](std::size_t first, std::size_t last) {
      return part(Index(first), Index(last - first));
    });
  };
  const double signal = square(
      [&](Index first, Index count) { return data.middleRows(first, count).cast<double>().squaredNorm(); });
  const double error = square([&](Index first, Index count) {
    const Matrix rest = data.middleRows(first, count) - weights.middleRows(first, count) * basis.transpose();
    return rest.cast<double>().squaredNorm();
  });
  const BtfError measured{signal, error, double(data.maxCoeff()), raw.btf.size()};
  result.se_db = measured.se_db();
  result.psnr_db = measured.psnr_db();
  return result;
}

}  // namespace nook::bake::material
