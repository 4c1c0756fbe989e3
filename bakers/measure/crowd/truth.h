// The reference of the crowd's ambient occlusion and light, by ray tracing.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <span>
#include <vector>

#include "bakers/measure/crowd/posed_crowd.h"

namespace nook::measure::crowd {

struct TraceSettings {
  std::uint32_t rays = 64;  // for each vertex
  std::uint64_t seed = 1;
  bool ground = true;  // whether the ground plane y = 0 occludes
};

// The AO of the receivers' vertices. All bodies near a receiver occlude it, and the ground does if it is
// in the settings.
VertexValues traced_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                       const TraceSettings& settings);

// A square of the ground plane y = 0 with side x side points. The first point lies at the low corner, and x
// runs fastest.
struct FloorPatch {
  float low_x_m = 0, low_z_m = 0, size_m = 1;
  std::uint32_t side = 2;
};

// The AO of the patch's points, which only the given characters occlude. Rays end after radius_m.
std::vector<float> traced_floor_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> casters,
                                   const FloorPatch& patch, float radius_m, const TraceSettings& settings);

// Irradiance, three floats for each point. All bodies and the ground are black, so that this is what
// occlusion alone leaves of the environment's light.
struct TracedIrradiance {
  VertexValues bodies;
  std::vector<float> floor;
};

// The irradiance of the receivers' vertices and, unless patch is null, of a patch of the floor.
TracedIrradiance traced_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch* patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings);

}  // namespace nook::measure::crowd
