// Computes values at points from groups of casters, such as bodies: AO, the open share of a cone of light,
// and the open share of coloured light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/geometry.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/world/world_kernels.h"

namespace nook::world {

// Casters that are near each other, such as the casters of a body.
struct CasterGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;  // centre of a sphere that contains the casters
  float radius = 0;
  float strength = 0;  // square metres; at distance d, the casters reduce AO by at most strength / d^2
};

// The groups of a scene, which a callback returns by index.
struct CasterGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  // Returns a group by its index. The returned group may point to `room`, so `room` must outlive it.
  CasterGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

struct SampleRequest {
  const float* positions = nullptr;  // three floats for each point
  const float* normals = nullptr;    // three floats for each point, unit length
  std::uint32_t count = 0;
  std::size_t stride = 3;             // distance between points in floats, in both arrays
  const LightTerms* terms = nullptr;  // the light for the coloured result; NULL: no coloured result
  float cutoff_error = 0;  // a difference in AO; a group is skipped for a block of points if it reduces their
                           // AO by less than this
  bool has_light = false;
  Vec3 light_axis;  // unit vector towards the light
  float light_half_angle_radians = 0;
};

// Writes one value per point to `ao`. If there is a cone, also writes one value per point to `light`. If
// there are terms, also writes three values per point to `rgb`. Each array may be NULL. A point with a
// position or normal that is not finite gets the results of an open point. Does not allocate, lock or throw.
void sample(const WorldKernels& kernels, const Parallel& parallel, const SampleRequest& request,
            const CasterGroups& groups, float* ao, float* light, float* rgb) noexcept;

}  // namespace nook::world
