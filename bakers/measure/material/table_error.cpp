#include "bakers/measure/material/table_error.h"

#include <algorithm>
#include <span>

#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/reflectance.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using nook::material::MaterialTables;
using tensor::Matrix;

// Returns the light modes of all texels for a view, as a matrix of light modes x texels (y varies fastest).
Matrix decoded_modes(const RawMaterial& raw, const MaterialTables& tables, Vec3 view) {
  Matrix modes(Index(raw.texels()), Index(tables.btf.light_modes));
  for (std::uint32_t x = 0; x < raw.width; ++x)
    for (std::uint32_t y = 0; y < raw.height; ++y) {
      const nook::material::Sample sample{
          (float(x) + 0.5f) / float(raw.width), (float(y) + 0.5f) / float(raw.height), 0, view, {0, 0, 1}};
      const std::size_t texel = std::size_t(x) * raw.height + y;
      nook::material::decode_modes(tables, sample,
                                   {modes.data() + texel * tables.btf.light_modes, tables.btf.light_modes});
    }
  return modes.transpose();
}

// Returns the radiances at a sample's point and for its view, under all lights, three values per light.
Matrix radiances(const RawMaterial& raw, const MaterialTables& tables, const Matrix& lights,
                 const nook::material::Sample& sample) {
  return decoded_radiances(
      raw, tables, lights,
      [&](std::span<float> modes) { nook::material::decode_modes(tables, sample, modes); },
      [&](std::span<float> sums) {
        decode_neural(tables.neural, {sample.u, sample.v, sample.level}, sample.view, sums);
      });
}

// Returns the raw radiances for one view and under each light, averaged over a square of texels.
Matrix mean_radiances(const RawMaterial& raw, std::size_t view, std::uint32_t x, std::uint32_t y,
                      std::uint32_t side) {
  Matrix mean = Matrix::Zero(Index(raw.light_rows()), 1);
  for (std::size_t row = 0; row < raw.light_rows(); ++row) {
    const float* const image = &raw.btf[(row * raw.views.size() + view) * raw.texels()];
    float sum = 0;
    for (std::uint32_t i = x; i < x + side; ++i)
      for (std::uint32_t j = y; j < y + side; ++j) sum += image[std::size_t(i) * raw.height + j];
    mean(Index(row), 0) = sum / float(side * side);
  }
  return mean;
}

}  // namespace

Matrix light_rows(const RawMaterial& raw, const MaterialTables& tables) {
  const std::size_t modes = tables.btf.light_modes;
  Matrix rows(Index(raw.light_rows()), Index(modes));
  std::vector<float> basis(3 * modes);
  for (std::size_t light = 0; light < raw.lights.size(); ++light) {
    nook::material::light_basis_at(tables, raw.lights[light], basis);
    std::copy(basis.begin(), basis.end(), rows.data() + 3 * light * modes);
  }
  return rows;
}

std::vector<LevelError> measure_levels(const RawMaterial& raw, const MaterialTables& tables) {
  const Matrix lights = tables.neural.is_used() ? Matrix() : light_rows(raw, tables);
  std::vector<LevelError> levels;
  for (std::uint32_t side = 2; raw.width % side == 0 && raw.height % side == 0; side *= 2) {
    std::vector<BtfError> mipmap(raw.views.size()), finest(raw.views.size());
    tensor::for_each_block(raw.views.size(), 1, [&](std::size_t view, std::size_t) {
      for (std::uint32_t x = 0; x < raw.width; x += side)
        for (std::uint32_t y = 0; y < raw.height; y += side) {
          const Matrix truth = mean_radiances(raw, view, x, y, side);
          nook::material::Sample sample{(float(x) + 0.5f * float(side)) / float(raw.width),
                                        (float(y) + 0.5f * float(side)) / float(raw.height),
                                        float(levels.size() + 1),
                                        raw.views[view],
                                        {0, 0, 1}};
          const std::span<const float> values(truth.data(), raw.light_rows());
          add_error(values, radiances(raw, tables, lights, sample).data(), mipmap[view]);
          sample.level = 0;
          add_error(values, radiances(raw, tables, lights, sample).data(), finest[view]);
        }
    });
    levels.push_back({side, sum_of_errors(mipmap).se_db(), sum_of_errors(finest).se_db()});
  }
  return levels;
}

BtfError measure_tables(const RawMaterial& raw, const MaterialTables& tables) {
  if (tables.btf.width != raw.width || tables.btf.height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the tables have %u x %u texels, but the raw material has %u x %u", tables.btf.width,
                  tables.btf.height, raw.width, raw.height);
  const Matrix lights = light_rows(raw, tables);
  const std::size_t views = raw.views.size(), texels = raw.texels();
  std::vector<BtfError> part(views);
  tensor::for_each_block(views, 1, [&](std::size_t view, std::size_t) {
    const Matrix decoded = lights * decoded_modes(raw, tables, raw.views[view]);
    for (std::size_t row = 0; row < raw.light_rows(); ++row) {
      const Eigen::Map<const Matrix> truth(&raw.btf[(row * views + view) * texels], 1, Index(texels));
      part[view].squared_signal += truth.cast<double>().squaredNorm();
      part[view].squared_error += (truth - decoded.row(Index(row))).cast<double>().squaredNorm();
    }
  });
  BtfError error;
  for (const BtfError& p : part) {
    error.squared_signal += p.squared_signal;
    error.squared_error += p.squared_error;
  }
  error.values = raw.btf.size();
  return error;
}

double table_bytes_texel(const MaterialTables& tables) {
  return double(nook::material::table_bytes(tables)) / (double(tables.btf.width) * tables.btf.height);
}

}  // namespace nook::bake::material
