// The input of a frame of the world pass: the host's images, groups of casters, light.
#pragma once

#include <nook/nook_world.h>

#include <optional>
#include <span>

#include "sdk/src/core/geometry.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/world/caster_parts.h"
#include "sdk/src/world/light_terms.h"

namespace nook::gl {

// Casters that stand together, in world space.
struct ReachingGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;
  float radius = 0;    // of a sphere around them
  float reach = 0;     // metres from the centre; points beyond it are not darkened
  float strength = 0;  // square metres; see caster_strength
  // In square metres. At the distance d, the casters take at most cutoff_error times this / d^2 of AO.
  float strength_over_cutoff = 0;
  const world::CasterParts* parts = nullptr;  // NULL: one caster

  // Returns the distance in metres from the centre at which one capsule begins to stand for the casters.
  float merging_distance(float level_error) const {
    // A single caster cannot be merged any further.
    return world::merging_distance(strength, radius, parts ? level_error : 0);
  }
};

// The groups of a frame. group(index) is called at most twice for each, and its result lives until the next
// call.
struct ReachingGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  ReachingGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

// Every point is within this reach; its square is still a float.
inline constexpr float endless_reach = 1e15f;

// A cone of light, in world space.
struct LightCone {
  Vec3 axis;  // unit, towards the light
  float half_angle_radians = 0;
  float reach = 0;  // metres
};

// A frame that passed its checks.
struct WorldFrame {
  NnaoFrame& screen;  // the pass stores what it learns about its images
  const float* view;  // column-major
  std::uint32_t ao_texture = 0;
  nook_world_combine composition = NOOK_WORLD_COMBINE_MULTIPLY;
  float level_error = 0;
  nook_world_view show = NOOK_WORLD_VIEW_AO;
  world::LightTerms light;  // in view space, for coloured passes
  std::optional<LightCone> cone;
};

}  // namespace nook::gl
