// Computes AO and the open share of a cone of light at points, from groups of casters such as bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/geometry.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/world/world_kernels.h"

namespace nook::world {

// Casters that stand together.
struct CasterGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;  // of a sphere that contains them
  float radius = 0;
  float strength = 0;  // square metres; the AO that they take at the distance d is at most strength / d^2
};

// The groups of a scene, each by its number.
struct CasterGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  // A group may refer to `room`, which must live as long as the group.
  CasterGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

struct SampleRequest {
  const float* positions = nullptr;  // three floats for each point
  const float* normals = nullptr;    // the same, with unit length
  std::uint32_t count = 0;
  std::size_t stride = 3;             // floats from point to point, in both arrays
  const LightTerms* terms = nullptr;  // of the light for the colours; NULL: none
  float cutoff_error = 0;             // AO; groups that take less from a block of points are skipped there
  bool has_light = false;
  Vec3 light_axis;  // unit, towards the light
  float light_half_angle_radians = 0;
};

// Writes `count` values to ao, to light if there is a cone, and three for each point to rgb if there are
// terms. Each array may be NULL. A point or normal that is not finite is open. Neither allocates nor locks
// nor throws.
void sample(const WorldKernels& kernels, const Parallel& parallel, const SampleRequest& request,
            const CasterGroups& groups, float* ao, float* light, float* rgb) noexcept;

}  // namespace nook::world
