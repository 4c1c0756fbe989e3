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

// Returns the number of texels for `rank` values, with four values in each texel. In spatial modes and
// coefficients, the four values belong to consecutive indices of the view mode. In the light map, they belong
// to consecutive indices of the light mode.
constexpr std::uint32_t vec4_count(std::uint32_t rank) {
  return (rank + 3) / 4;
}

// Chooses a block format for the spatial modes. If blocks are used, the modes outside blocks are stored as
// integers instead of half floats. The light map then has fewer cells, and its values are fitted so that it
// is exact at the sampled lights.
struct ModeForm {
  BlockForm blocks = BlockForm::none;
  // The number of light modes of a BTF that are not stored in blocks. These are the first light modes,
  // because blocks would lose most precision there. The number is rounded up to a multiple of 4.
  std::uint32_t whole_light_modes = 4;
};

// All values are half floats, except for the membership and for spatial modes that have 8 bits or are in
// blocks.
struct TensorTables {
  explicit TensorTables(Memory* memory = default_memory())
      : spatial(memory), spatial_8(memory), blocks(memory), coefficients(memory), membership(memory) {}

  std::uint32_t width = 0, height = 0;  // of level 0
  std::uint32_t levels = 0;
  std::uint32_t light_modes = 0;      // R_l of a BTF, rounded up to a multiple of 4; 1 for a VOTF
  std::uint32_t view_vec4_count = 0;  // R_v / 4, rounded up
  std::uint32_t clusters = 0;
  std::uint32_t side = 0;   // cells along a side of the view map
  std::uint32_t terms = 0;  // terms of each cell; see ViewCells
  bool blended = false;     // true if cells blend with their neighbours; see ViewCells
  std::uint32_t bits = 16;  // format of the spatial modes that are not in blocks: 16 for half floats, 8 for
                            // integers
  BlockForm block_form = BlockForm::none;
  std::uint32_t packed_modes = 0;  // the number of light modes in blocks; these are the last ones

  // Mipmap levels are stored one after another, each with layers x height x width x 4 values. Mode S_c[a, b]
  // of spatial_modes.h is component b % 4 of layer (c whole_modes() + a) view_vec4_count + b / 4. Half floats
  // are multiplied by a power of two, which is the same for the whole tensor. With 8 bits, a mode is divided
  // by its scale p_c[b] r[a] instead, and stored times 127 as an integer from -127 to 127. The coefficients
  // are multiplied by p_c[b], and the light map by r[a].
  Vector<std::uint16_t> spatial;
  Vector<std::int8_t> spatial_8;
  // The modes in blocks. They are divided by the same scales. Light mode whole_modes() + a begins at layer 2
  // ((c packed_modes + a) view_vec4_count + b / 4).
  Vector<std::uint8_t> blocks;
  // terms x view_vec4_count layers, each with side x side x 4 values.
  Vector<std::uint16_t> coefficients;
  // Each layer has side x side x 4 values and stores four terms. If cells blend, ViewCells::neighbours is
  // stored as one more term. Empty if there is a single cluster and cells do not blend. A value takes
  // member_bytes() bytes.
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

  TensorTables btf;     // for a neural material, only its width and height in texels are set
  NeuralTables neural;  // replaces `btf` and `light`
  TensorTables votf;    // empty if `visibility` is none
  VisibilityForm visibility = VisibilityForm::none;
  VisibilityMapping mapping;
  ReliefTables relief;  // of the BTF

  std::uint32_t light_side = 64;
  // The light basis over the hemisphere, interpolated linearly between the lights. Between the lowest lights
  // and the horizon, the basis fades to 0; see low_light_share. The table has layers x side x side x 4
  // floats; light mode a of a channel is in layer channel light_modes / 4 + a / 4. Values are divided by the
  // power of two of the BTF's spatial modes. If modes are in blocks, the table has fewer texels. The texels
  // around each light are then adjusted so that filtering at the direction of a light returns the light's row
  // of the basis. The result is exact except for rounding, and except for values above the maximum of the
  // default table, which are clamped.
  Vector<float> light;
  // With 8 bits, light_8 replaces `light`. The light map's columns are multiplied by r[a], divided by the
  // largest value, and stored as integers from -127 to 127. The coefficients are multiplied by the largest
  // value.
  Vector<std::int8_t> light_8;

  // XXH64 of the data from which the light basis and the VOTF were made. Other baked data, such as radiance
  // transfer, store these hashes, so that a wrong material can be detected. votf_hash is 0 if there is no
  // VOTF.
  std::uint64_t light_hash = 0, votf_hash = 0;
};

inline constexpr std::uint32_t default_map_side = 256;

// Makes the tables of a material that passed check_material. map_side is the size, in cells, of the view maps
// that are made if the material has none; see view_cells.h. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if
// the blocks take too many bytes; see check_block_bytes.
MaterialTables make_tables(const Material& material, const Parallel& parallel, Memory* memory,
                           std::uint32_t map_side = default_map_side, const ModeForm& form = {});

std::uint64_t table_bytes(const MaterialTables& tables);

}  // namespace nook::material
