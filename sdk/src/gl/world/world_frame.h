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
  float radius = 0;    // of a sphere round them
  float reach = 0;     // metres from the centre; no point beyond it is darkened
  float strength = 0;  // square metres, see caster_strength
  // Square metres; the AO that they take at the distance d is at most cutoff_error times this / d^2.
  float strength_over_cutoff = 0;
  const world::CasterParts* parts = nullptr;  // NULL: one caster

  // Metres from the centre where one capsule begins to stand for the casters.
  float merging_distance(float level_error) const {
    // One caster has no level below it.
    return world::merging_distance(strength, radius, parts ? level_error : 0);
  }
};

// The groups of a frame. group(index) is called for each at most twice, and what it returns lives until the
// next call.
struct ReachingGroups {
  std::uint32_t count = 0;
  const void* user = nullptr;
  ReachingGroup (*group)(const void* user, std::uint32_t index, PosedCaster& room) = nullptr;
};

// No point is beyond this reach; its square is still a float.
inline constexpr float endless_reach = 1e15f;

// A cone of light, in world space.
struct LightCone {
  Vec3 axis;  // unit, towards the light
  float half_angle_radians = 0;
  float reach = 0;  // metres
};

// A frame that passed its checks.
struct WorldFrame {
  NnaoFrame& screen;  // whose images the pass learns about
  const float* view;  // column-major
  std::uint32_t ao_texture = 0;
  nook_world_combine composition = NOOK_WORLD_COMBINE_MULTIPLY;
  float level_error = 0;
  nook_world_view show = NOOK_WORLD_VIEW_AO;
  world::LightTerms light;  // in view space; of coloured passes
  std::optional<LightCone> cone;
};

}  // namespace nook::gl
