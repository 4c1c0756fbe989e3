// Blends the darkening by other casters from key points to vertices.
#pragma once

#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Fills model.blend; key points need their surface frames, the linear layer its alphas.
//
// What a caster takes from a surface is nearly linear in its normal (a plane's share is exactly: (1 - cos) /
// 2), and what holds for normals in every pose holds for whatever light is blocked. So the weights w of a
// vertex minimise, over the poses p,
//   mean_p |sum_k w_k n_k(p) - n(p)|^2 + c |sum_k w_k x_k(p) - x(p)|^2 + r |w|^2,   sum_k w_k = 1,
// n and x the vertex's posed normal and position, n_k and x_k those of its key points' surface frames. Some
// come out negative: key points inside the curve of a limb extrapolate to the vertices outside. They are
// rounded to the steps of the file one by one, each time solving anew for those left, so that the rounding of
// one is made up by the others.
void fit_blend_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses);

}  // namespace nook::bake
