#include "sdk/src/core/failure.h"
#include "sdk/src/material/check.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/packed_numbers.h"

namespace nook::material {
namespace {

void write_rows(ByteWriter& out, const ViewRows& rows, const TensorShape& shape) {
  if (shape.clusters > 1)
    for (const std::uint16_t cluster : rows.membership)
      shape.clusters > 256 ? out.u16(cluster) : out.u8(cluster);
  write_packed(out, rows.coefficients);
}

ByteWriter write_tensor(const ClusteredTensor& tensor) {
  ByteWriter out;
  const TensorShape& s = tensor.shape;
  for (const std::uint32_t size :
       {s.width, s.height, s.rank_light, s.rank_view, s.rank_x, s.rank_y, s.clusters})
    out.u16(size);
  out.u8(s.mixture);
  write_packed(out, tensor.cores);
  write_packed(out, tensor.x_bases);
  write_packed(out, tensor.y_bases);
  write_rows(out, tensor.rows, s);
  return out;
}

ByteWriter write_map(const ClusteredTensor& tensor) {
  ByteWriter out;
  out.u16(tensor.map.side);
  write_rows(out, tensor.map.rows, tensor.shape);
  return out;
}

}  // namespace

std::vector<std::byte> write_material(const Material& material) {
  check_material(material, NOOK_ERROR_INVALID_ARGUMENT);
  std::vector<ContainerSection> sections;
  const auto add = [&](const char(&name)[5], const ByteWriter& out) {
    sections.push_back({four_letters(name), out.bytes()});
  };
  ByteWriter head, directions, light, recipe;
  head.u16(static_cast<std::uint32_t>(material.lights.size()));
  head.u16(static_cast<std::uint32_t>(material.views.size()));
  head.u8(static_cast<std::uint32_t>(material.visibility));
  head.f32(material.mapping.threshold);
  head.f32(material.mapping.weight);
  add("HEAD", head);
  for (const auto* set : {&material.lights, &material.views})
    for (const Vec3 d : *set) {
      directions.f32(d.x);
      directions.f32(d.y);
      directions.f32(d.z);
    }
  add("DIRS", directions);
  write_packed(light, material.light_basis);
  add("LGHT", light);
  add("BTF_", write_tensor(material.btf));
  if (material.btf.map.side) add("BMAP", write_map(material.btf));
  if (material.visibility != VisibilityForm::none) {
    add("VOTF", write_tensor(material.votf));
    if (material.votf.map.side) add("VMAP", write_map(material.votf));
  }
  recipe.text(material.recipe);
  add("RECP", recipe);
  return write_container(material_kind, sections);
}

Material quantise(const Material& material) {
  return read_material(write_material(material));
}

}  // namespace nook::material
