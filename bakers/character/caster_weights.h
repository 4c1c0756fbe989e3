// Fits the weights with which proxy spheres darken other objects, against ray tracing.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct CasterFitSettings {
  std::size_t poses = 48;  // maximum number of poses, picked at even intervals
  // Random points and normals per pose. Most points are 0.3 to 8 body radii from the centre of the body. A
  // tenth of the points are near its surface, to represent neighbours that touch the body.
  std::size_t points_per_pose = 600;
  std::uint32_t rays = 256;  // per point
  std::uint64_t seed = 1;
};

// Sets caster_weight (>= 0) of every sphere to the non-negative least-squares solution of
//   solid_depth(sum over spheres of caster_weight * form factor) = -log(1 - traced occlusion)
// at points outside the body. Relative errors count the same near and far. Spheres of one body that overlap
// share the occlusion of the space that they cover, so that one character does not darken a point twice. The
// optical depths of different casters are added.
void fit_caster_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                        const CasterFitSettings& settings,
                        const std::function<bool(std::size_t, std::size_t)>& progress = {});

}  // namespace nook::bake
