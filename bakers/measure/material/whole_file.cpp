#include "bakers/measure/material/whole_file.h"

#include <algorithm>

#include "sdk/src/material/material_file.h"

namespace nook::bake::material {
namespace {

using nook::material::ClusteredTensor;
using nook::material::Material;
using nook::material::TensorShape;
using nook::material::ViewRows;
using nook::material::VisibilityForm;

// Rows that take as much room in a file as any others of the shape.
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
  // A view rank adds the same number of bytes each time.
  const std::size_t first = whole_file_bytes(blank_n_svd(raw, s, 1), 0);
  const auto views = std::uint32_t(raw.views.size());
  if (first > max_bytes || views < 2) return first <= max_bytes;
  const std::size_t step = whole_file_bytes(blank_n_svd(raw, s, 2), 0) - first;
  return std::min(views, std::uint32_t(1 + (max_bytes - first) / step));
}

}  // namespace nook::bake::material
