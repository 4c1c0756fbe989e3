#include "sdk/src/core/failure.h"
#include "sdk/src/material/map_rows.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/packed_numbers.h"

namespace nook::material {
namespace {

struct Head {
  std::uint32_t lights = 0, views = 0;
};

Head read_head(ByteReader in, std::uint32_t version, Material& material) {
  Head head;
  head.lights = in.u16();
  head.views = in.u16();
  const std::uint32_t form = in.u8();
  if (form > std::uint32_t(VisibilityForm::distance))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the form of visibility is unknown (got %u, need 0 to 2); use a newer library", form);
  material.visibility = VisibilityForm(form);
  material.mapping.threshold = in.f32();
  material.mapping.weight = in.f32();
  if (version >= 2) material.bits = in.u8();
  if (material.bits != 8 && material.bits != 16)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the number format is unknown (got %u bits, need 8 or 16); use a newer library",
                  material.bits);
  in.check_end();
  return head;
}

void read_directions(ByteReader& in, std::uint32_t count, Vector<Vec3>& directions) {
  in.check_count(count, 96, "directions");
  directions.resize(count);
  for (Vec3& d : directions) {
    d.x = in.f32();
    d.y = in.f32();
    d.z = in.f32();
  }
}

// Reads `count` values. For integers, `slab` is the number of values in a slab, and the function returns the
// step. If the section is too short for the values, it throws before it allocates.
float read_numbers(ByteReader& in, std::uint32_t bits, std::size_t count, std::size_t slab, const char* what,
                   Vector<float>& values) {
  if (bits == 16 ? count > in.remaining() / 2 : min_multiples_bytes(count) > in.remaining())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s is too short for its %s (got %zu bytes for %zu); bake the file again",
                  in.name(), what, in.remaining(), count);
  values.resize(count);
  if (bits == 8) return read_multiples(in, values, slab);
  read_packed(in, values);
  return 0;
}

void read_rows(ByteReader& in, std::uint32_t bits, const TensorShape& shape, std::size_t count,
               ViewRows& rows) {
  const std::size_t numbers = coefficient_count(shape, count), members = view_rows_bytes(shape, count, 0);
  if (members + (bits == 16 ? 2 * numbers : min_multiples_bytes(numbers)) > in.remaining())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s is too short for its rows (got %zu bytes for %zu); bake the file again",
                  in.name(), in.remaining(), count);
  rows.membership.resize(count * shape.mixture);
  if (shape.clusters > 1)
    for (std::uint16_t& cluster : rows.membership)
      cluster = std::uint16_t(shape.clusters > 256 ? in.u16() : in.u8());
  read_numbers(in, bits, numbers, numbers, "coefficients", rows.coefficients);
}

// Reads a tensor. For integers, returns the step of the cores.
float read_tensor(ByteReader in, const Material& material, std::size_t lights, const char* name,
                  ClusteredTensor& tensor) {
  TensorShape& s = tensor.shape;
  s.views = static_cast<std::uint32_t>(material.views.size());
  for (std::uint32_t* size :
       {&s.width, &s.height, &s.rank_light, &s.rank_view, &s.rank_x, &s.rank_y, &s.clusters})
    *size = in.u16();
  s.mixture = in.u8();
  check_shape(s, lights, material.views.size(), name, NOOK_ERROR_BAD_FILE);
  const std::uint32_t bits = material.bits;
  const float step = read_numbers(in, bits, s.clusters * core_size(s), core_slab(s), "cores", tensor.cores);
  read_numbers(in, bits, s.clusters * x_basis_size(s), x_basis_size(s), "x bases", tensor.x_bases);
  read_numbers(in, bits, s.clusters * y_basis_size(s), y_basis_size(s), "y bases", tensor.y_bases);
  read_rows(in, bits, s, s.views, tensor.rows);
  in.check_end();
  return step;
}

void read_map(ByteReader in, std::uint32_t bits, ClusteredTensor& tensor) {
  tensor.map.side = in.u16();
  const TensorShape& s = tensor.shape;
  const std::size_t cells = std::size_t(tensor.map.side) * tensor.map.side;
  if (bits == 16) {
    read_rows(in, bits, s, cells, tensor.map.rows);
  } else {
    if (min_map_bytes(s, cells) > in.remaining())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s is too short for its rows (got %zu bytes for %zu); bake the file again",
                    in.name(), in.remaining(), cells);
    read_map_rows(in, s, tensor.map);
  }
  in.check_end();
}

void read_relief(ByteReader in, Relief& relief) {
  relief.steps = in.u8();
  relief.low = in.f32();
  relief.high = in.f32();
  relief.max_slope = in.f32();
  relief.levels.resize(in.remaining());
  for (std::uint8_t& level : relief.levels) level = std::uint8_t(in.u8());
}

void read_neural(ByteReader in, Neural& neural) {
  NeuralShape& s = neural.shape;
  s.width = in.u16();
  s.height = in.u16();
  for (std::uint32_t* size : {&s.channels, &s.units, &s.layers, &s.offset_channels, &s.offset_units})
    *size = in.u8();
  check_neural_shape(s, NOOK_ERROR_BAD_FILE);
  if (in.remaining() != neural_bytes(s))
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "section %s has the wrong length (got %zu bytes after its sizes, need %zu); bake the file again",
        in.name(), in.remaining(), neural_bytes(s));
  neural.blocks.resize(neural_block_bytes_of(s));
  for (std::uint8_t& byte : neural.blocks) byte = std::uint8_t(in.u8());
  neural.weights.resize(NeuralLayout(s).count);
  for (std::uint16_t& weight : neural.weights) weight = std::uint16_t(in.u16());
}

// Reads the light basis and the BTF.
void read_btf(const Container& file, const Head& head, Material& material) {
  const float step = read_tensor(file.section("BTF_"), material, head.lights, "BTF", material.btf);
  // Increases the error by 1 %, so that the writer chooses the same step if the material is written again.
  if (const float error = error_of_step(material.btf.cores, step); error > 0 && error < 0.9f)
    material.core_rounding = 1.01f * error;
  ByteReader light = file.section("LGHT");
  const std::size_t light_numbers = std::size_t(3) * head.lights * material.btf.shape.rank_light;
  read_numbers(light, material.bits, light_numbers, light_numbers, "basis", material.light_basis);
  light.check_end();
  if (file.has("BMAP")) read_map(file.section("BMAP"), material.bits, material.btf);
  if (file.version() >= 3 && file.has("RELF")) read_relief(file.section("RELF"), material.relief);
}

}  // namespace

Material read_material(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, material_kind);
  Material material(memory);
  const Head head = read_head(file.section("HEAD"), file.version(), material);
  ByteReader directions = file.section("DIRS");
  read_directions(directions, head.lights, material.lights);
  read_directions(directions, head.views, material.views);
  directions.check_end();
  if (file.version() >= 4 && file.has("NEUR"))
    read_neural(file.section("NEUR"), material.neural);
  else
    read_btf(file, head, material);
  if (material.visibility != VisibilityForm::none) {
    read_tensor(file.section("VOTF"), material, 0, "VOTF", material.votf);
    if (file.has("VMAP")) read_map(file.section("VMAP"), material.bits, material.votf);
  }
  ByteReader recipe = file.section("RECP");
  material.recipe = recipe.text(recipe.remaining());
  check_material(material, NOOK_ERROR_BAD_FILE);
  return material;
}

}  // namespace nook::material
