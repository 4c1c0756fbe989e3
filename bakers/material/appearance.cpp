#include "bakers/material/appearance.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "bakers/raytrace/hemisphere.h"
#include "bakers/tensor/gram.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/spatial_modes.h"

namespace nook::bake::material {
namespace {

using nook::material::ClusteredTensor;
using nook::material::TensorShape;
using tensor::Matrix;

constexpr std::uint32_t radiance_sums = 256, visibility_sums = 64;

// The index of the sum that a value is added to, and the sign of the value.
struct Place {
  std::uint32_t sum;
  float sign;
};
Place place_of(std::uint64_t value, std::uint64_t seed, std::uint32_t sums) {
  const std::uint64_t bits = mix_bits(value ^ mix_bits(seed));
  return {std::uint32_t((bits >> 32) % sums), bits & 1u ? 1.0f : -1.0f};
}

// Adds the values of a raw image, times the sign, to one sum per texel. A texel has the index x * height + y
// in the image, and y * width + x in `sums`.
void add_image(const float* image, std::uint32_t width, std::uint32_t height, Place place, Matrix& sums) {
  for (std::uint32_t x = 0; x < width; ++x)
    for (std::uint32_t y = 0; y < height; ++y)
      sums(Eigen::Index(y) * width + x, place.sum) += place.sign * image[std::size_t(x) * height + y];
}

// `images` contains the images of all views for the first row, then for the next row.
Matrix sums_of(const std::vector<float>& images, std::size_t rows, const RawMaterial& raw, std::uint32_t sums,
               std::uint64_t seed) {
  const std::size_t views = raw.views.size(), count = rows * views;
  std::vector<std::vector<std::size_t>> images_of(sums);
  for (std::size_t i = 0; i < count; ++i) images_of[place_of(i, seed, sums).sum].push_back(i);
  Matrix out = Matrix::Zero(Eigen::Index(raw.texels()), sums);
  // One thread computes a sum, in a fixed order, so that the bits are always the same.
  tbb::parallel_for(std::uint32_t{0}, sums, [&](std::uint32_t sum) {
    for (const std::size_t i : images_of[sum])
      add_image(&images[i * raw.texels()], raw.width, raw.height, place_of(i, seed, sums), out);
  });
  return out;
}

// Returns a square R with R^T R = U^T U for the light basis U, so |R a| = |U a| for every vector a.
Matrix lengths_of(const nook::material::Material& material) {
  const Eigen::Index rank = material.btf.shape.rank_light;
  const Eigen::Map<const Matrix> basis(material.light_basis.data(),
                                       Eigen::Index(material.light_basis.size()) / rank, rank);
  const Eigen::MatrixXd gram = basis.cast<double>().transpose() * basis.cast<double>();
  // The shift keeps the Cholesky factor real if the basis is rank-deficient.
  const double shift = 1e-9 * gram.trace() + 1e-30;
  const Eigen::MatrixXd shifted = gram + shift * Eigen::MatrixXd::Identity(rank, rank);
  return Matrix(shifted.llt().matrixL().transpose().toDenseMatrix().cast<float>());
}

// Each sum is a weighted sum of the modes S_c[a, b]. Returns the weights for one cluster, one row per sum.
Matrix weights_of(const ClusteredTensor& t, std::uint32_t cluster, const Matrix& lengths, std::uint32_t sums,
                  std::uint64_t seed) {
  const TensorShape& s = t.shape;
  Matrix out = Matrix::Zero(sums, Eigen::Index(s.rank_light) * s.rank_view);
  for (std::uint32_t view = 0; view < s.views; ++view)
    for (std::uint32_t k = 0; k < s.mixture; ++k) {
      const std::size_t entry = std::size_t(view) * s.mixture + k;
      if (t.rows.membership[entry] != cluster) continue;
      for (std::uint32_t row = 0; row < s.rank_light; ++row) {
        const Place place = place_of(std::uint64_t(view) * s.rank_light + row, seed, sums);
        for (std::uint32_t a = 0; a < s.rank_light; ++a)
          for (std::uint32_t b = 0; b < s.rank_view; ++b)
            out(place.sum, Eigen::Index(a) * s.rank_view + b) +=
                place.sign * lengths(row, a) * t.rows.coefficients[entry * s.rank_view + b];
      }
    }
  return out;
}

Matrix sums_of(const ClusteredTensor& t, const Matrix& lengths, std::uint32_t sums, std::uint64_t seed) {
  const TensorShape& s = t.shape;
  const Eigen::Index texels = Eigen::Index(s.width) * s.height,
                     modes = Eigen::Index(s.rank_light) * s.rank_view;
  Matrix out = Matrix::Zero(texels, sums), images(modes, texels);
  for (std::uint32_t cluster = 0; cluster < s.clusters; ++cluster) {
    const nook::material::ModeExpansion expansion(t, cluster, default_memory());
    tbb::parallel_for(Eigen::Index{0}, modes, [&](Eigen::Index mode) {
      std::vector<float> scratch(expansion.scratch_size());
      expansion.expand(std::uint32_t(mode) / s.rank_view, std::uint32_t(mode) % s.rank_view, scratch,
                       {images.row(mode).data(), std::size_t(texels)});
    });
    const Matrix weights = weights_of(t, cluster, lengths, sums, seed);
    constexpr Eigen::Index block = 512;
    tbb::parallel_for(Eigen::Index{0}, (texels + block - 1) / block, [&](Eigen::Index i) {
      const Eigen::Index first = i * block, count = std::min(block, texels - first);
      out.middleRows(first, count).noalias() +=
          images.middleCols(first, count).transpose() * weights.transpose();
    });
  }
  return out;
}

// Scales the samples to a total variance of 1 around their mean.
void normalise(Matrix& samples) {
  const Eigen::RowVectorXf mean = samples.cast<double>().colwise().mean().cast<float>();
  samples.rowwise() -= mean;
  const double variance = samples.cast<double>().squaredNorm() / double(samples.rows());
  if (variance > 0) samples *= float(1 / std::sqrt(variance));
}

Matrix joined(Matrix radiance, Matrix visibility, std::uint32_t channels) {
  normalise(radiance);
  if (visibility.size() != 0) {
    normalise(visibility);
    Matrix both(radiance.rows(), radiance.cols() + visibility.cols());
    both << radiance, visibility;
    radiance = std::move(both);
  }
  return tensor::project(radiance, tensor::principal_components(radiance, channels));
}

}  // namespace

Matrix appearance_of(const RawMaterial& raw, std::uint64_t seed, std::uint32_t channels) {
  Matrix visibility;
  if (!raw.mask.empty()) visibility = sums_of(raw.mask, 1, raw, visibility_sums, seed);
  return joined(sums_of(raw.btf, raw.light_rows(), raw, radiance_sums, seed), std::move(visibility),
                channels);
}

Matrix appearance_of(const nook::material::Material& material, std::uint64_t seed, std::uint32_t channels) {
  nook::material::refuse_neural(material.neural.is_used(), "synthesis without raw data");
  Matrix visibility;
  if (material.visibility != nook::material::VisibilityForm::none)
    visibility = sums_of(material.votf, Matrix::Identity(1, 1), visibility_sums, seed);
  return joined(sums_of(material.btf, lengths_of(material), radiance_sums, seed), std::move(visibility),
                channels);
}

}  // namespace nook::bake::material
