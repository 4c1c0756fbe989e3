#include "sdk/src/gl/material/material_textures.h"

#include <algorithm>
#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/functions.h"
#include "sdk/src/gl/material/material_glsl.h"
#include "sdk/src/gl/material/texture_array.h"
#include "sdk/src/gl/shader_program.h"

namespace nook::gl {
namespace {

using material::MaterialTables;
using material::TensorTables;

constexpr std::uint32_t guaranteed_layers = 256;  // guaranteed by OpenGL 3.3

std::size_t texture_count(const TensorTables& t, std::uint32_t max_layers) {
  return t.terms == 0
             ? 0
             : array_count(t, max_layers) + block_array_count(t, max_layers) + 1 + t.has_membership();
}

void check_blocks(const Functions& gl, const TensorTables& t) {
  const bool is_rgtc = t.block_form == material::BlockForm::rgtc;
  if (t.block_form == material::BlockForm::none) return;
  if (!(is_rgtc ? gl.can.rgtc_textures : gl.can.eac_textures))
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "this %s does not support the block compression of the material's modes (got %s, need %s); "
                  "load the material with another value of desc.blocks",
                  api_name(gl), is_rgtc ? "NOOK_MATERIAL_BLOCKS_RGTC" : "NOOK_MATERIAL_BLOCKS_EAC",
                  gl.can.rgtc_textures  ? "NOOK_MATERIAL_BLOCKS_RGTC or _NONE"
                  : gl.can.eac_textures ? "NOOK_MATERIAL_BLOCKS_EAC or _NONE"
                                        : "NOOK_MATERIAL_BLOCKS_NONE");
  // The WebGL extension requires that the width and height of the finest level are multiples of 4.
  if (is_rgtc && gl.profile == Profile::webgl && (t.width % 4 != 0 || t.height % 4 != 0))
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "WebGL does not allow RGTC textures of the material's size (got %u x %u texels, need "
                  "multiples of 4); load the material with NOOK_MATERIAL_BLOCKS_NONE",
                  t.width, t.height);
}

// Checks that the sizes and layers of the textures are within the limits of this OpenGL context.
void check_limits(const Functions& gl, const MaterialTables& tables, std::uint32_t max_layers) {
  const auto side = std::uint32_t(integer(gl, GL_MAX_TEXTURE_SIZE));
  const auto layers = std::uint32_t(integer(gl, GL_MAX_ARRAY_TEXTURE_LAYERS));
  for (const TensorTables* t : {&tables.btf, &tables.votf}) {
    check_blocks(gl, *t);
    const std::uint32_t largest = std::max({t->width, t->height, t->side});
    if (largest > side)
      throw Failure(
          NOOK_ERROR_UNSUPPORTED,
          "the material needs larger textures than this OpenGL supports (got %u texels, need at most %u)",
          largest, side);
    if (t->terms * t->view_vec4_count > layers)
      throw Failure(
          NOOK_ERROR_UNSUPPORTED,
          "the material's coefficients need more layers than this OpenGL has (got %u, need at most %u); "
          "bake it with a view map or a smaller view rank",
          t->terms * t->view_vec4_count, layers);
  }
  const material::ImageSize& features = tables.neural.size;
  if (features.layers > layers)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the material's features need more layers than this OpenGL has (got %u, need at most %u)",
                  features.layers, layers);
  const std::size_t count = 1 + std::size_t(tables.relief.steps > 0) + texture_count(tables.btf, max_layers) +
                            texture_count(tables.votf, max_layers);
  if (count > MaterialTextures::max_textures)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the material needs more textures than a shader can read (got %zu with %u layers each, "
                  "need at most %zu); allow more layers, or bake it with smaller ranks or fewer clusters",
                  count, max_layers, MaterialTextures::max_textures);
}

}  // namespace

MaterialTextures::MaterialTextures(Device& device, const MaterialTables& tables, std::uint32_t max_layers)
    : textures_(device.memory), source_(device.memory) {
  const Functions& gl = device.gl;
  const auto most =
      std::uint32_t(std::max(integer(gl, GL_MAX_ARRAY_TEXTURE_LAYERS), GLint(guaranteed_layers)));
  max_layers = max_layers == 0 ? most : std::min(max_layers, most);
  check_limits(gl, tables, max_layers);
  source_ = material_source(tables, max_layers, device.memory);
  textures_.reserve(max_textures);
  set_plain_unpacking(gl);
  tables.neural.is_used() ? add_features(device, tables.neural) : add_btf(device, tables, max_layers);
  if (tables.votf.terms != 0) add_tensor(device, tables.votf, "votf", max_layers);
  bytes_ = material::table_bytes(tables);
}

void MaterialTextures::add_features(Device& device, const material::NeuralTables& tables) {
  const material::ImageSize& size = tables.size;
  const auto layers = GLsizei(size.layers);
  textures_.push_back({make_texture_array(device,
                                          {ArrayUse::spatial_8, GLsizei(size.width), GLsizei(size.height), 0,
                                           layers, layers, GLsizei(size.levels)},
                                          tables.features.data(), "nook: features"),
                       "nook_neural_features"});
}

void MaterialTextures::add_btf(Device& device, const MaterialTables& tables, std::uint32_t max_layers) {
  const auto light_layers = GLsizei(3 * tables.btf.light_modes / 4), light_side = GLsizei(tables.light_side);
  const bool is_integer = !tables.light_8.empty();
  const void* const light =
      is_integer ? static_cast<const void*>(tables.light_8.data()) : tables.light.data();
  textures_.push_back({make_texture_array(device,
                                          {is_integer ? ArrayUse::light_8 : ArrayUse::light, light_side,
                                           light_side, 0, light_layers, light_layers, 1},
                                          light, "nook: light map"),
                       "nook_light_map"});
  if (const material::ReliefTables& r = tables.relief; r.steps > 0)
    textures_.push_back(
        {make_texture_array(
             device, {ArrayUse::heights, GLsizei(r.width), GLsizei(r.height), 0, 1, 1, GLsizei(r.levels)},
             r.heights.data(), "nook: relief"),
         "nook_relief_heights"});
  add_tensor(device, tables.btf, "btf", max_layers);
}

void MaterialTextures::add_tensor(Device& device, const TensorTables& t, const char* name,
                                  std::uint32_t max_layers) {
  const auto add = [&](const ArrayPlan& plan, const void* data, const char* what, int number) {
    Texture texture;
    const int length = std::snprintf(texture.uniform, sizeof texture.uniform, "nook_%s_%s", name, what);
    if (number >= 0) std::snprintf(texture.uniform + length, sizeof texture.uniform - length, "_%d", number);
    texture.object = make_texture_array(device, plan, data, texture.uniform);
    textures_.push_back(std::move(texture));
  };
  const auto side = GLsizei(t.side), coefficient_layers = GLsizei(t.terms * t.view_vec4_count),
             membership_layers = GLsizei(material::vec4_count(t.memberships())), layers = GLsizei(t.layers());
  add({ArrayUse::coefficients, side, side, 0, coefficient_layers, coefficient_layers, 1},
      t.coefficients.data(), "coefficients", -1);
  if (t.has_membership())
    add({t.member_bytes() == 1 ? ArrayUse::membership_8 : ArrayUse::membership, side, side, 0,
         membership_layers, membership_layers, 1},
        t.membership.data(), "membership", -1);
  int number = 0;
  for (GLsizei first = 0; first < layers; first += GLsizei(max_layers))
    add({t.bits == 8 ? ArrayUse::spatial_8 : ArrayUse::spatial, GLsizei(t.width), GLsizei(t.height), first,
         std::min(layers - first, GLsizei(max_layers)), layers, GLsizei(t.levels)},
        t.bits == 8 ? static_cast<const void*>(t.spatial_8.data()) : t.spatial.data(), "spatial", number++);
  const auto block_layers = GLsizei(t.block_size().layers), most = GLsizei(most_block_layers(max_layers));
  number = 0;
  for (GLsizei first = 0; first < block_layers; first += most)
    add({t.block_form == material::BlockForm::rgtc ? ArrayUse::rgtc : ArrayUse::eac, GLsizei(t.width),
         GLsizei(t.height), first, std::min(block_layers - first, most), block_layers, GLsizei(t.levels)},
        t.blocks.data(), "blocks", number++);
}

CoordinateTexture::CoordinateTexture(Device& device, const synthesis::Coordinates& coordinates)
    : source_(device.memory), bytes_(sizeof(synthesis::Cell) * coordinates.cells.size()) {
  const auto most = std::uint32_t(integer(device.gl, GL_MAX_TEXTURE_SIZE));
  if (coordinates.side > most)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the plane is larger than the largest texture of this OpenGL (got %u texels, need at most %u)",
        coordinates.side, most);
  char definitions[200];
  std::snprintf(definitions, sizeof definitions,
                "#define NOOK_SYNTHESIS_SIDE %u.0\n#define NOOK_SYNTHESIS_MATERIAL_TEXELS vec2(%u.0, %u.0)\n",
                coordinates.side, coordinates.width, coordinates.height);
  source_ = definitions;
  source_ += embedded_text("synthesis/host.glsl");
  set_plain_unpacking(device.gl);
  const auto side = GLsizei(coordinates.side);
  texture_ = make_texture_array(device, {ArrayUse::coordinates, side, side, 0, 1, 1, 1},
                                coordinates.cells.data(), "nook: synthesis");
}

}  // namespace nook::gl
