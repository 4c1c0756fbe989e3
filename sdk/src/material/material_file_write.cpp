#include "sdk/src/core/failure.h"
#include "sdk/src/material/map_rows.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/packed_numbers.h"

namespace nook::material {
namespace {

void write_numbers(ByteWriter& out, std::uint32_t bits, std::span<const float> values, std::size_t slab) {
  bits == 16 ? write_packed(out, values)
             : write_multiples(out, values, slab, step_of_largest(values, steps_of_largest));
}

// The squared error that rounding the VOTF's cores may cause, relative to the squared norm of the cores.
// These cores are small arrays, so we can afford an error that is far below the error of the compression.
constexpr float votf_rounding = 0x1p-16f;

void write_rows(ByteWriter& out, std::uint32_t bits, const ViewRows& rows, const TensorShape& shape) {
  if (shape.clusters > 1)
    for (const std::uint16_t cluster : rows.membership)
      shape.clusters > 256 ? out.u16(cluster) : out.u8(cluster);
  write_numbers(out, bits, rows.coefficients, rows.coefficients.size());
}

ByteWriter write_tensor(std::uint32_t bits, const ClusteredTensor& tensor, float core_rounding) {
  ByteWriter out;
  const TensorShape& s = tensor.shape;
  for (const std::uint32_t size :
       {s.width, s.height, s.rank_light, s.rank_view, s.rank_x, s.rank_y, s.clusters})
    out.u16(size);
  out.u8(s.mixture);
  if (bits == 16)
    write_packed(out, tensor.cores);
  else
    write_multiples(out, tensor.cores, core_slab(s), step_of_error(tensor.cores, core_rounding));
  write_numbers(out, bits, tensor.x_bases, x_basis_size(s));
  write_numbers(out, bits, tensor.y_bases, y_basis_size(s));
  write_rows(out, bits, tensor.rows, s);
  return out;
}

ByteWriter write_map(std::uint32_t bits, const ClusteredTensor& tensor) {
  ByteWriter out;
  out.u16(tensor.map.side);
  if (bits == 16)
    write_rows(out, bits, tensor.map.rows, tensor.shape);
  else
    write_map_rows(out, tensor.map, tensor.shape);
  return out;
}

ByteWriter write_relief(const Relief& relief) {
  ByteWriter out;
  out.u8(relief.steps);
  out.f32(relief.low);
  out.f32(relief.high);
  out.f32(relief.max_slope);
  for (const std::uint8_t level : relief.levels) out.u8(level);
  return out;
}

ByteWriter write_neural(const Neural& neural) {
  ByteWriter out;
  const NeuralShape& s = neural.shape;
  out.u16(s.width);
  out.u16(s.height);
  for (const std::uint32_t size : {s.channels, s.units, s.layers, s.offset_channels, s.offset_units})
    out.u8(size);
  for (const std::uint8_t byte : neural.blocks) out.u8(byte);
  for (const std::uint16_t weight : neural.weights) out.u16(weight);
  return out;
}

ByteWriter write_light(const Material& material) {
  ByteWriter out;
  write_numbers(out, material.bits, material.light_basis, material.light_basis.size());
  return out;
}

// Picks the lowest possible version, so that older libraries can read the file. Libraries that know only
// version 2 can draw materials without a relief. Libraries of version 3 can draw all materials except neural
// ones.
ContainerKind kind_of(const Material& material) {
  ContainerKind kind = material_kind;
  kind.newest_version = material.neural.is_used() ? 4 : material.relief.moves() ? 3 : 2;
  return kind;
}

}  // namespace

std::vector<std::byte> write_material(const Material& material) {
  check_material(material, NOOK_ERROR_INVALID_ARGUMENT);
  std::vector<ContainerSection> sections;
  const auto add = [&](const char(&name)[5], const ByteWriter& out) {
    sections.push_back({four_letters(name), out.bytes()});
  };
  ByteWriter head, directions, recipe;
  head.u16(static_cast<std::uint32_t>(material.lights.size()));
  head.u16(static_cast<std::uint32_t>(material.views.size()));
  head.u8(static_cast<std::uint32_t>(material.visibility));
  head.f32(material.mapping.threshold);
  head.f32(material.mapping.weight);
  head.u8(material.bits);
  add("HEAD", head);
  for (const auto* set : {&material.lights, &material.views})
    for (const Vec3 d : *set) {
      directions.f32(d.x);
      directions.f32(d.y);
      directions.f32(d.z);
    }
  add("DIRS", directions);
  if (material.neural.is_used()) {
    add("NEUR", write_neural(material.neural));
  } else {
    add("LGHT", write_light(material));
    add("BTF_", write_tensor(material.bits, material.btf, material.core_rounding));
  }
  if (material.btf.map.side) add("BMAP", write_map(material.bits, material.btf));
  if (material.visibility != VisibilityForm::none) {
    add("VOTF", write_tensor(material.bits, material.votf, votf_rounding));
    if (material.votf.map.side) add("VMAP", write_map(material.bits, material.votf));
  }
  if (material.relief.moves()) add("RELF", write_relief(material.relief));
  recipe.text(material.recipe);
  add("RECP", recipe);
  return write_container(kind_of(material), sections);
}

Material quantise(const Material& material) {
  return read_material(write_material(material));
}

}  // namespace nook::material
