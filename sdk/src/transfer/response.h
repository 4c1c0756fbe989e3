// The response of a material to a lobe from any direction of tangent space,
//   P[c, a](d) = integral of exp(sharpness (dot(d, s) - 1)) phi[c, a](s) over the upper hemisphere,
// on a square grid of the equal-area map p = d.xy / sqrt(1 + d.z), in which the hemisphere is the unit disc.
// Between nodes, the response is interpolated bilinearly. The values at the nodes are not samples of P. They
// are chosen to minimise the squared error of the interpolation on a finer grid, so that the interpolation
// does not blur P.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/vector_kernels.h"

namespace nook::transfer {

// The directions at which a material's light modes are needed. They divide the upper hemisphere into cells of
// equal solid angle.
struct HemisphereCells {
  HemisphereCells(float sharpness, Memory* memory);

  Vector<Vec3> direction;
  float solid_angle = 0;  // of each cell, in steradians
};

// The light basis of a material at these directions: cells x 3 x light_modes values, channel by channel.
struct LightModes {
  std::span<const float> values;
  std::uint32_t light_modes = 0;
  Vec3 reflectance{};  // mean reflectance under uniform light, [0, 1]
  std::uint64_t light_hash = 0, votf_hash = 0;
};

struct Response {
  explicit Response(Memory* memory) : row_begin(memory), row_end(memory), even(memory) {}

  std::uint32_t lobes = 0;
  std::uint32_t light_modes = 0;  // light modes of one channel
  std::uint32_t lanes = 0;        // light_modes rounded up to a multiple of the widest vector, 16

  // The position in the grid is p * scale + centre, in [0, side - 1] along each axis. A lobe whose direction
  // is lower than lowest_z has no effect.
  std::uint32_t side = 0;
  float scale = 0, centre = 0, lowest_z = 0;
  // For each row, the range [begin, end) of nodes that bilinear interpolation can read.
  Vector<std::uint16_t> row_begin, row_end;
  AlignedArray<float> table;  // side x side x 3 x lanes

  // The axes of the lobes. Axes of 0 pad the arrays to a multiple of 16.
  AlignedArray<float> axis_x, axis_y, axis_z;
  std::uint32_t padded = 0;

  Vector<float> even;  // 3 x light_modes integrals of the light basis, the response to uniform light
  Vec3 reflectance;
  std::uint64_t light_hash = 0, votf_hash = 0;  // the hashes of the material
};

// Pass HemisphereCells(sharpness_of(lobes)) as `cells`.
Response make_response(std::uint32_t lobes, const HemisphereCells& cells, const LightModes& modes,
                       Memory* memory);

}  // namespace nook::transfer
