#include "bakers/lab/material/equal_bytes.h"

#include <Eigen/QR>
#include <algorithm>

#include "bakers/raytrace/hemisphere.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/material/material_file.h"

namespace nook::lab {
namespace {

using namespace bake;
using namespace bake::material;

using nook::material::ClusteredTensor;
using nook::material::Material;
using nook::material::TensorShape;
using nook::material::ViewRows;
using nook::material::VisibilityForm;

// Returns rows without content. In a file, they take as many bytes as any rows of this shape.
ViewRows blank_rows(const TensorShape& shape, std::size_t count) {
  ViewRows rows;
  rows.membership.resize(count * shape.mixture);
  for (std::size_t i = 0; i < rows.membership.size(); ++i)
    rows.membership[i] = std::uint16_t(i % shape.mixture);
  rows.coefficients.resize(nook::material::coefficient_count(shape, count));
  return rows;
}

void add_blank_map(ClusteredTensor& tensor, std::uint32_t side) {
  if (tensor.map.side != 0) return;
  tensor.map.side = side;
  tensor.map.rows = blank_rows(tensor.shape, std::size_t(side) * side);
}

ClusteredTensor blank_tensor(const TensorShape& shape) {
  ClusteredTensor tensor;
  tensor.shape = shape;
  tensor.cores.resize(shape.clusters * core_size(shape));
  tensor.x_bases.resize(shape.clusters * x_basis_size(shape));
  tensor.y_bases.resize(shape.clusters * y_basis_size(shape));
  tensor.rows = blank_rows(shape, shape.views);
  return tensor;
}

Material blank_n_svd(const RawMaterial& raw, const CompressionSettings& s, std::uint32_t rank_view) {
  Material material;
  material.lights.assign(raw.lights.begin(), raw.lights.end());
  material.views.assign(raw.views.begin(), raw.views.end());
  material.light_basis.resize(raw.light_rows() * s.rank_light);
  TensorShape shape{std::uint32_t(raw.views.size()),
                    raw.width,
                    raw.height,
                    s.rank_light,
                    rank_view,
                    s.rank_x,
                    s.rank_y,
                    1,
                    1};
  material.btf = blank_tensor(shape);
  if (raw.mask.empty() || s.visibility == VisibilityForm::none) return material;
  shape.rank_light = 1;
  shape.rank_x = s.votf_rank_x;
  shape.rank_y = s.votf_rank_y;
  material.visibility = s.visibility;
  material.mapping = default_mapping(s.visibility, raw.width, raw.height);
  material.votf = blank_tensor(shape);
  return material;
}

using Eigen::Index;
using tensor::Matrix;
using DataMap = Eigen::Map<const Matrix>;

constexpr std::size_t block = 512;  // rows
// The number of subspace iterations. Each iteration reduces the error of the last components. The factor
// depends on the ratio of neighbouring singular values. On the built-in materials, more iterations change the
// signal-to-error ratio (S/E) by less than 0.01 dB.
constexpr int iterations = 6;

// Returns A B, computed in blocks of rows of A.
Matrix times(const DataMap& a, const Matrix& b) {
  Matrix product(a.rows(), b.cols());
  tensor::for_each_block(std::size_t(a.rows()), block, [&](std::size_t first, std::size_t last) {
    product.middleRows(Index(first), Index(last - first)).noalias() =
        a.middleRows(Index(first), Index(last - first)) * b;
  });
  return product;
}

// Returns A^T B, computed in blocks of columns of A.
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

std::size_t whole_file_bytes(const Material& material, std::uint32_t map_side) {
  if (map_side == 0) return nook::material::write_material(material).size();
  Material whole = material;
  add_blank_map(whole.btf, map_side);
  if (whole.visibility != VisibilityForm::none) add_blank_map(whole.votf, map_side);
  return nook::material::write_material(whole).size();
}

std::size_t bytes_beside_btf(std::span<const std::byte> file) {
  const Container container(file, nook::material::material_kind);
  std::size_t btf = 0;
  const auto add = [&](const char(&name)[5]) {
    if (container.has(name)) btf += container.section(name).remaining();
  };
  add("LGHT");
  add("BTF_");
  add("BMAP");
  add("NEUR");
  return file.size() - btf;
}

std::uint32_t n_svd_view_rank(const RawMaterial& raw, const CompressionSettings& s, std::size_t max_bytes) {
  // Each view rank adds the same number of bytes.
  const std::size_t first = whole_file_bytes(blank_n_svd(raw, s, 1), 0);
  const auto views = std::uint32_t(raw.views.size());
  if (first > max_bytes || views < 2) return first <= max_bytes;
  const std::size_t step = whole_file_bytes(blank_n_svd(raw, s, 2), 0) - first;
  return std::min(views, std::uint32_t(1 + (max_bytes - first) / step));
}

PcaResult fit_pca(const RawMaterial& raw, std::size_t bytes, std::uint64_t seed) {
  const DataMap data(raw.btf.data(), Index(raw.light_rows() * raw.views.size()), Index(raw.texels()));
  PcaResult result;
  const std::size_t component_bytes = 2 * std::size_t(data.rows() + data.cols());
  result.components = std::min({bytes / component_bytes, std::size_t(data.rows()), std::size_t(data.cols())});
  if (result.components == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%zu bytes are too few for one principal component of %zu bytes", bytes, component_bytes);
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

}  // namespace nook::lab
