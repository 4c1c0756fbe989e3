// The response of a material to a lobe from any direction of tangent space,
//   P[c, a](d) = integral of exp(sharpness (dot(d, s) - 1)) phi[c, a](s) over the upper hemisphere,
// on a square grid of the equal-area map p = d.xy / sqrt(1 + d.z), in which the hemisphere is the unit disc.
// Between nodes the response is bilinear. The nodes have the values with the smallest squared error over a
// finer grid, so that bilinear mixing does not blur.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/vector_kernels.h"

namespace nook::transfer {

// The directions at which a material's light modes are needed: the upper hemisphere in equal areas.
struct HemisphereCells {
  HemisphereCells(float sharpness, Memory* memory);

  Vector<Vec3> direction;
  float solid_angle = 0;  // of each
};

// Light modes of a material at these directions: cells x 3 x light_modes, channel by channel.
struct LightModes {
  std::span<const float> values;
  std::uint32_t light_modes = 0;
  Vec3 reflectance{};  // of the material under even light, [0, 1]
  std::uint64_t light_hash = 0, votf_hash = 0;
};

struct Response {
  explicit Response(Memory* memory) : row_begin(memory), row_end(memory), even(memory) {}

  std::uint32_t lobes = 0;
  std::uint32_t light_modes = 0;  // of a channel
  std::uint32_t lanes = 0;        // light_modes rounded up to a multiple of the widest vector, 16

  // place = p * scale + centre, in [0, side - 1] along each axis; a lobe below lowest_z has no effect.
  std::uint32_t side = 0;
  float scale = 0, centre = 0, lowest_z = 0;
  // The nodes of each row that mixing can reach: [begin, end).
  Vector<std::uint16_t> row_begin, row_end;
  AlignedArray<float> table;  // side x side x 3 x lanes

  // The axes of the lobes, padded to a multiple of 16 with an axis of 0.
  AlignedArray<float> axis_x, axis_y, axis_z;
  std::uint32_t padded = 0;

  Vector<float> even;  // 3 x light_modes integrals of the light basis: the response to even light
  Vec3 reflectance;
  std::uint64_t light_hash = 0, votf_hash = 0;  // of the material
};

// Pass the cells HemisphereCells(sharpness_of(lobes)).
Response make_response(std::uint32_t lobes, const HemisphereCells& cells, const LightModes& modes,
                       Memory* memory);

}  // namespace nook::transfer
