// Kernels that compute, at many points, the fraction of the hemisphere or of a light cone that casters leave
// open. There is a table of plain functions for each instruction set. The caller owns the arrays of points.
// They must be padded to a multiple of simd_width with finite values. The functions do not allocate, lock or
// throw.
#pragma once

#include <cstdint>

#include "sdk/src/core/geometry.h"
#include "sdk/src/core/isa.h"
#include "sdk/src/world/cone.h"
#include "sdk/src/world/light_terms.h"

namespace nook::world {

// Points in world space, in metres. Normals must have unit length.
struct PointSoa {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  const float *nx = nullptr, *ny = nullptr, *nz = nullptr;
  std::uint32_t padded_count = 0;
};

// The arrays of gathered terms, in the order of GatheredTerms.
struct GatheredSoa {
  static constexpr int lanes = light_term_count;
  float* lane[lanes] = {};
};

struct WorldKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // open[i] *= the product over the casters of 1 - coverage.
  void (*open_hemisphere)(const PosedCaster* casters, std::uint32_t count, const PointSoa& points,
                          float* open);
  // Like open_hemisphere, but also adds each caster to the gathered terms.
  void (*gather_hemisphere)(const PosedCaster* casters, std::uint32_t count, const PointSoa& points,
                            float* open, const GatheredSoa& gathered);
  // Writes the open share of the light for each colour channel. Pass the AO as `open`.
  void (*open_light)(const LightTerms& light, const PointSoa& points, const GatheredSoa& gathered,
                     const float* open, float* const* rgb);
  // open[i] *= the product over the casters of 1 - part_coverage, for one part of a cone.
  void (*open_part)(const PosedCaster* casters, std::uint32_t count, const PointSoa& points, Vec3 axis,
                    float slope, float* open);
};

// Returns the table of one instruction set, or NULL if the processor or the build lacks it.
const WorldKernels* world_kernels(Isa isa);

}  // namespace nook::world

// Declares, for each instruction set, the function that returns its table. Each instruction set has its own
// translation unit. Use a table only on a processor that has the instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  namespace nook::isa_##name {                   \
    const world::WorldKernels& world_kernels();  \
  }
#include "sdk/src/core/isa_list.inl"
