// Fits the weights of proxy spheres for darkening other things, against ray tracing.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct CasterFitSettings {
  std::size_t poses = 48;  // at most this many poses, evenly chosen
  // Random points and normals. Most are 0.3 to 8 body radii away from the body's middle. A tenth is near its
  // surface, for neighbours that touch it.
  std::size_t points_per_pose = 600;
  std::uint32_t rays = 256;  // per point
  std::uint64_t seed = 1;
};

// Sets caster_weight of every sphere, >= 0: the non-negative least-squares solution of
//   solid_depth(sum over spheres of caster_weight * form factor) = -log(1 - traced occlusion)
// at points outside the body, relative errors weighed alike near and far. Overlapping spheres share what they
// cover, so that one character does not darken twice; what several casters add is a sum of the same optical
// depth.
void fit_caster_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                        const CasterFitSettings& settings,
                        const std::function<bool(std::size_t, std::size_t)>& progress = {});

}  // namespace nook::bake
