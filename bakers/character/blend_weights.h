// The weights that blend the darkening by other casters from key points to vertices.
#pragma once

#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Fills model.blend; key points need their surface frames, the linear layer its alphas.
//
// What a plane takes from a surface is linear in its normal: (1 - cos) / 2. What a sphere takes is not: its
// share f is near 0 for all normals that face away, so that weights that are right for planes alone blend too
// much where a surface turns away from a neighbour, and it falls within a few of its radii. So the weights w
// of a vertex minimise, over the poses p and spheres s of random directions and distances from the vertex,
//   mean_p |sum_k w_k n_k(p) - n(p)|^2 + c |sum_k w_k x_k(p) - x(p)|^2 + r |w|^2
//     + a mean_ps (d_s / r_s)^4 (sum_k w_k f_s(x_k(p), n_k(p)) - f_s(x(p), n(p)))^2,   sum_k w_k = 1,
// n and x the vertex's posed normal and position, n_k and x_k those of its key points' surface frames, d_s
// the sphere's distance and r_s its radius, which make near and far spheres count alike. Some
// come out negative: key points inside the curve of a limb extrapolate to the vertices outside. They are
// rounded to the steps of the file one by one, each time solving anew for those left, so that the rounding of
// one is made up by the others.
void fit_blend_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses);

}  // namespace nook::bake
