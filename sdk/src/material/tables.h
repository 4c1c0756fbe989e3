// The tables that decode a material on the CPU and on the GPU, in the layout of the textures.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/material.h"
#include "sdk/src/material/neural_tables.h"
#include "sdk/src/material/relief_tables.h"

namespace nook::material {

// Returns the number of groups of four. The four numbers of a texel hold four neighbours of a mode: of the
// view mode in spatial modes and coefficients, and of the light mode in the light map.
constexpr std::uint32_t vec4_count(std::uint32_t rank) {
  return (rank + 3) / 4;
}

// Chooses blocks for the spatial modes. Then integers replace half floats, and the light map has fewer cells,
// whose values are fitted to the lights.
struct ModeForm {
  BlockForm blocks = BlockForm::none;
  // The first light modes of a BTF stay integers, because blocks would lose most there. Rounded up to a
  // multiple of 4.
  std::uint32_t whole_light_modes = 4;
};

// All numbers are half floats, except for the membership, and for spatial modes with 8 bits or in blocks.
struct TensorTables {
  explicit TensorTables(Memory* memory = default_memory())
      : spatial(memory), spatial_8(memory), blocks(memory), coefficients(memory), membership(memory) {}

  std::uint32_t width = 0, height = 0;  // of level 0
  std::uint32_t levels = 0;
  std::uint32_t light_modes = 0;      // R_l of a BTF, rounded up to a multiple of 4; 1 for a VOTF
  std::uint32_t view_vec4_count = 0;  // R_v / 4, rounded up
  std::uint32_t clusters = 0;
  std::uint32_t side = 0;   // cells of the view map
  std::uint32_t terms = 0;  // of a cell; see ViewCells
  bool blended = false;     // cells blend with their neighbours; see ViewCells
  std::uint32_t bits = 16;  // of spatial modes that are not in blocks
  BlockForm block_form = BlockForm::none;
  std::uint32_t packed_modes = 0;  // the number of light modes in blocks, which are the last ones

  // One level after another: layers x height x width x 4. Number b % 4 of layer (c whole_modes() + a)
  // view_vec4_count + b / 4 is the mode S_c[a, b] of spatial_modes.h, times a power of two for the whole
  // tensor. With 8 bits, it is divided by the mode's scale p_c[b] r[a] instead, and stored as 127 times that,
  // an integer from -127 to 127. The coefficients and the light map contain the factors of the scale.
  Vector<std::uint16_t> spatial;
  Vector<std::int8_t> spatial_8;
  // Modes in blocks, also with a scale. Light mode whole_modes() + a begins at layer 2 ((c packed_modes + a)
  // view_vec4_count + b / 4).
  Vector<std::uint8_t> blocks;
  // terms x view_vec4_count layers of side x side x 4.
  Vector<std::uint16_t> coefficients;
  // Layers of side x side x 4, with four terms each. If cells blend, the last term holds the neighbours of
  // ViewCells. Empty for a single cluster without blending. Numbers take member_bytes().
  Vector<std::uint8_t> membership;

  std::uint32_t memberships() const { return terms + (blended ? 1 : 0); }
  bool has_membership() const { return clusters > 1 || blended; }
  std::uint32_t member_bytes() const { return clusters <= 256 ? 1 : 2; }
  std::uint32_t whole_modes() const { return light_modes - packed_modes; }
  std::uint32_t layers() const { return clusters * whole_modes() * view_vec4_count; }
  ImageSize image_size() const { return {width, height, layers(), levels}; }
  BlockSize block_size() const {
    return {width, height, 2 * clusters * packed_modes * view_vec4_count, levels};
  }
};

struct MaterialTables {
  explicit MaterialTables(Memory* memory = default_memory())
      : btf(memory), neural(memory), votf(memory), relief(memory), light(memory), light_8(memory) {}

  TensorTables btf;     // for a neural material, only the sizes of its texels
  NeuralTables neural;  // replaces btf and light
  TensorTables votf;    // empty if visibility is none
  VisibilityForm visibility = VisibilityForm::none;
  VisibilityMapping mapping;
  ReliefTables relief;  // of the BTF

  std::uint32_t light_side = 64;
  // The light basis over the hemisphere, interpolated linearly between the lights. Beyond the outermost
  // lights, their basis is scaled by the ratio of cosines, down to 0 at the horizon. The table has layers x
  // side x side x 4 floats, with layer channel light_modes / 4 + a / 4. It is divided by the power of two of
  // the BTF's spatial modes. With modes in blocks it is smaller. Its texels around each light are then moved
  // so that the light gets its row of the basis, except for rounding and for numbers above the default map's
  // largest.
  Vector<float> light;
  // With 8 bits, this replaces `light`. The light map's columns are multiplied by r[a], divided by their
  // largest number, and stored as integers from -127 to 127. The coefficients are multiplied by that number.
  Vector<std::int8_t> light_8;

  // XXH64 of the numbers from which the light basis and the VOTF were made, for data baked with them.
  // votf_hash is 0 without a VOTF.
  std::uint64_t light_hash = 0, votf_hash = 0;
};

inline constexpr std::uint32_t default_map_side = 256;

// Makes the tables of a material that passed check_material. map_side is the side in cells of the view maps
// that the tables get if the material has none; see view_cells.h. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT)
// for blocks of too many bytes; see check_block_bytes.
MaterialTables make_tables(const Material& material, const Parallel& parallel, Memory* memory,
                           std::uint32_t map_side = default_map_side, const ModeForm& form = {});

std::uint64_t table_bytes(const MaterialTables& tables);

}  // namespace nook::material
