#include "bakers/material/btf_error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "bakers/material/raw_relief.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using nook::material::ClusteredTensor;
using nook::material::NeuralTables;
using tensor::Matrix;
using ConstMap = Eigen::Map<const Matrix>;

void need_sizes(const RawMaterial& raw, const ClusteredTensor& t, const char* what) {
  const auto& s = t.shape;
  if (s.views != raw.views.size() || s.width != raw.width || s.height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the %s has %u views and %u x %u texels, but the raw material has %zu views and %u x %u "
                  "texels; give the raw file that the material was baked from",
                  what, s.views, s.width, s.height, raw.views.size(), raw.width, raw.height);
}

void need_texels(const RawMaterial& raw, std::uint32_t width, std::uint32_t height, const char* what) {
  if (width != raw.width || height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the %s has %u x %u texels, but the raw material has %u x %u; give "
                  "the raw file that the material was baked from",
                  what, width, height, raw.width, raw.height);
}

NeuralTables neural_tables(const nook::material::Material& material) {
  return make_neural_tables(material.neural, material.views, material.lights, default_memory());
}

// Returns sum_k sum_b coefficient Z_c[a, b], expanded to texels: R_l x (I_x I_y).
Matrix light_modes(const ClusteredTensor& t, std::size_t view) {
  const auto& s = t.shape;
  const std::size_t slice = std::size_t(s.rank_x) * s.rank_y, core = nook::material::core_size(s);
  Matrix modes = Matrix::Zero(s.rank_light, Index(s.width) * s.height);
  for (std::size_t k = 0; k < s.mixture; ++k) {
    const std::size_t c = t.rows.membership.empty() ? 0 : t.rows.membership[view * s.mixture + k];
    const float* coefficients = &t.rows.coefficients[(view * s.mixture + k) * s.rank_view];
    for (std::size_t a = 0; a < s.rank_light; ++a) {
      Matrix mixed = Matrix::Zero(s.rank_x, s.rank_y);
      for (std::size_t b = 0; b < s.rank_view; ++b)
        mixed += coefficients[b] *
                 ConstMap(&t.cores[c * core + (a * s.rank_view + b) * slice], s.rank_x, s.rank_y);
      if (s.rank_x < s.width) mixed = ConstMap(&t.x_bases[c * x_basis_size(s)], s.width, s.rank_x) * mixed;
      if (s.rank_y < s.height)
        mixed = mixed * ConstMap(&t.y_bases[c * y_basis_size(s)], s.height, s.rank_y).transpose();
      modes.row(Index(a)) += ConstMap(mixed.data(), 1, mixed.size());
    }
  }
  return modes;
}

// Converts images of the relief's points to the images that a view sees.
Matrix seen(const nook::material::Material& material, std::size_t view, const Matrix& images) {
  if (!material.relief.moves()) return images;
  const auto& shape = material.btf.shape;
  const std::vector<Taps> taps =
      relief_taps(material.relief, shape.width, shape.height, material.views[view]);
  Matrix out(images.rows(), images.cols());
  for (Index row = 0; row < images.rows(); ++row)
    for (std::size_t t = 0; t < taps.size(); ++t)
      out(row, Index(t)) = mean_of(taps[t], images.data() + row * images.cols());
  return out;
}

// Adds up the errors of all views. decode(view) must return all rows of one view.
template <class Decode>
BtfError error_of_views(const RawMaterial& raw, const Decode& decode) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  std::vector<BtfError> part(views);
  tensor::for_each_block(views, 1, [&](std::size_t view, std::size_t) {
    const Matrix decoded = decode(view);
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      add_error({&raw.btf[(row * views + view) * texels], texels}, decoded.row(Index(row)).data(),
                part[view]);
  });
  return sum_of_errors(part);
}

void need_lights(const RawMaterial& raw, std::size_t numbers, std::uint32_t rank) {
  if (numbers != raw.light_rows() * rank)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the light basis has %zu lights, but the raw material has %zu",
                  numbers / (3 * rank), raw.lights.size());
}

}  // namespace

double signal_to_error_db(double squared_signal, double squared_error) {
  return 10 * std::log10(squared_signal / squared_error);
}

double BtfError::psnr_db() const {
  return 10 * std::log10(peak * peak * double(values) / squared_error);
}

double BtfError::psnr_toned_db() const {
  return 10 * std::log10(double(values) / squared_error_toned);
}

Matrix decode_btf_view(const std::vector<float>& light_basis, const ClusteredTensor& btf, std::size_t view) {
  const auto rank = Index(btf.shape.rank_light);
  return ConstMap(light_basis.data(), Index(light_basis.size()) / rank, rank) * light_modes(btf, view);
}

std::vector<float> decode_votf_view(const ClusteredTensor& votf, std::size_t view) {
  const Matrix value = light_modes(votf, view);
  return {value.data(), value.data() + value.size()};
}

float toned(float radiance) {
  const float y = std::max(std::numbers::pi_v<float> * radiance, 0.0f);
  return std::sqrt(y / (1 + y));
}

void add_error(std::span<const float> truth, const float* decoded, BtfError& error) {
  const ConstMap a(truth.data(), 1, Index(truth.size())), b(decoded, 1, Index(truth.size()));
  error.squared_signal += a.cast<double>().squaredNorm();
  error.squared_error += (a - b).cast<double>().squaredNorm();
  error.squared_error_toned += (a.unaryExpr(&toned) - b.unaryExpr(&toned)).cast<double>().squaredNorm();
  error.peak = std::max(error.peak, double(a.maxCoeff()));
  error.values += truth.size();
}

BtfError sum_of_errors(std::span<const BtfError> parts) {
  BtfError error;
  for (const BtfError& part : parts) {
    error.squared_signal += part.squared_signal;
    error.squared_error += part.squared_error;
    error.squared_error_toned += part.squared_error_toned;
    error.peak = std::max(error.peak, part.peak);
    error.values += part.values;
  }
  return error;
}

Matrix draw_neural(const NeuralTables& tables, Vec3 view, std::span<const Vec3> lights) {
  const auto& s = tables.shape;
  Matrix drawn(Index(3 * lights.size()), Index(s.texels()));
  std::vector<float> decoded(tables.decoded_count());
  for (std::uint32_t x = 0; x < s.width; ++x)
    for (std::uint32_t y = 0; y < s.height; ++y) {
      const Index texel = Index(x) * s.height + y;
      decode_neural(tables, {(float(x) + 0.5f) / float(s.width), (float(y) + 0.5f) / float(s.height), 0},
                    view, decoded);
      for (std::size_t l = 0; l < lights.size(); ++l) {
        const Vec3 radiance = neural_radiance(tables, decoded, lights[l]);
        drawn.block(Index(3 * l), texel, 3, 1) << radiance.x, radiance.y, radiance.z;
      }
    }
  return drawn;
}

Matrix decode_btf_view(const nook::material::Material& material, std::size_t view) {
  if (material.neural.is_used())
    return draw_neural(neural_tables(material), material.views[view], material.lights);
  const auto rank = Index(material.btf.shape.rank_light);
  return ConstMap(material.light_basis.data(), Index(material.light_basis.size()) / rank, rank) *
         seen(material, view, light_modes(material.btf, view));
}

BtfError measure_btf(const RawMaterial& raw, const std::vector<float>& light_basis,
                     const ClusteredTensor& btf) {
  need_sizes(raw, btf, "BTF");
  need_lights(raw, light_basis.size(), btf.shape.rank_light);
  return error_of_views(raw, [&](std::size_t view) { return decode_btf_view(light_basis, btf, view); });
}

BtfError measure_btf(const RawMaterial& raw, const nook::material::Material& material) {
  if (material.neural.is_used()) {
    const NeuralTables tables = neural_tables(material);
    need_texels(raw, tables.shape.width, tables.shape.height, "neural material");
    return error_of_views(raw,
                          [&](std::size_t view) { return draw_neural(tables, raw.views[view], raw.lights); });
  }
  need_sizes(raw, material.btf, "BTF");
  need_lights(raw, material.light_basis.size(), material.btf.shape.rank_light);
  return error_of_views(raw, [&](std::size_t view) { return decode_btf_view(material, view); });
}

BtfError measure_neural_tile(const RawMaterial& raw, const NeuralTile& tile) {
  return error_of_views(
      raw, [&](std::size_t view) { return draw_neural_tile(tile, raw.views[view], raw.lights); });
}

std::size_t count_error_texels(const RawMaterial& raw, const ClusteredTensor& votf,
                               nook::material::VisibilityForm form) {
  need_sizes(raw, votf, "VOTF");
  const float threshold = form == nook::material::VisibilityForm::binary ? 0.5f : 0;
  std::atomic<std::size_t> wrong{0};
  tensor::for_each_block(raw.views.size(), 1, [&](std::size_t view, std::size_t) {
    const std::vector<float> value = decode_votf_view(votf, view);
    std::size_t here = 0;
    for (std::size_t i = 0; i < value.size(); ++i)
      here += (value[i] > threshold) != (raw.mask[view * raw.texels() + i] > 0.5f);
    wrong += here;
  });
  return wrong;
}

}  // namespace nook::bake::material
