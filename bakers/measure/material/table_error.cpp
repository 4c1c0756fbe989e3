#include "bakers/measure/material/table_error.h"

#include <algorithm>

#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/evaluate.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using nook::material::MaterialTables;
using tensor::Matrix;

// The light basis of all lights and channels, 3 lights x light modes.
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

// The light modes of all texels for a view, light modes x texels (x slow, y fast).
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

}  // namespace

BtfError measure_tables(const RawMaterial& raw, const MaterialTables& tables) {
  if (tables.btf.width != raw.width || tables.btf.height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the tables are of %u x %u texels, the raw material of %u x %u", tables.btf.width,
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
