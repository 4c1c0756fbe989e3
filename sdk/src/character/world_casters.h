// The world casters of instances in their poses.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook {

// Poses the casters of an instance if its pose has changed since the last call. Neither allocates nor throws.
void pose_world_casters(Instance& instance) noexcept;

// An occluder as a caster.
inline PosedCaster caster_of(const Sphere& sphere) {
  return {{sphere.centre, sphere.centre, sphere.radius, sphere.radius}, 1};
}

// The largest AO that a caster takes at a distance d from it is at most this over d^2: the form factor of its
// silhouette, which is at most that of a disc and a rectangle that face the point.
float caster_strength(const PosedCaster& caster);

}  // namespace nook
