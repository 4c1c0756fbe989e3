// The input of a frame of the world pass: the host's images, groups of occluders (casters), and light.
#pragma once

#include <nook/nook_world.h>

#include <optional>
#include <span>

#include "sdk/src/core/geometry.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/world/caster_parts.h"
#include "sdk/src/world/light_terms.h"

namespace nook::gl {

// Casters that are close together, for example of one body, in world space.
struct ReachingGroup {
  std::span<const PosedCaster> casters;
  Vec3 centre;
  float radius = 0;    // radius of a sphere around the casters
  float reach = 0;     // metres from the centre; points beyond it are not darkened
  float strength = 0;  // square metres; see caster_strength
  // strength_over_cutoff is in square metres. At the distance d, the casters reduce AO by at most
  // cutoff_error * strength_over_cutoff / d^2.
  float strength_over_cutoff = 0;
  const world::CasterParts* parts = nullptr;  // NULL: the group has one caster

  // Returns the distance from the centre, in metres, beyond which one merged capsule replaces the casters.
  float merging_distance(float level_error) const {
    // A single caster is never merged. An error of 0 gives an endless distance.
    return world::merging_distance(strength, radius, parts ? level_error : 0);
  }
};

// The groups of a frame. group(index) is called at most twice for each group. Its result must stay valid
// until the next call.
struct ReachingGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  ReachingGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

// A reach, in metres, that includes every point. Its square does not overflow a float.
inline constexpr float endless_reach = 1e15f;

// A cone of light, in world space.
struct LightCone {
  Vec3 axis;  // unit, towards the light
  float half_angle_radians = 0;
  float reach = 0;  // metres
};

// A frame of the world pass that has passed all checks.
struct WorldFrame {
  NnaoFrame& screen;  // the pass stores facts about the images here
  const float* view;  // column-major
  std::uint32_t ao_texture = 0;
  nook_world_combine composition = NOOK_WORLD_COMBINE_MULTIPLY;
  float level_error = 0;
  nook_world_view show = NOOK_WORLD_VIEW_AO;
  world::LightTerms light;  // in view space, for coloured passes
  std::optional<LightCone> cone;
};

}  // namespace nook::gl
