// Fits the weights that interpolate the AO from other casters from key points to vertices.
#pragma once

#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Fills model.blend. Before the call, set the surface frames of the key points and the alphas of the linear
// layer.
//
// The occlusion by a plane is linear in the surface's normal: (1 - cos) / 2. The occlusion f by a sphere is
// not linear. It is near 0 for all normals that face away, and it falls off within a few radii of the sphere.
// So weights that are exact for planes give too much occlusion where a surface turns away from a neighbour.
// We draw spheres s with random directions and distances from the vertex, and minimise over the poses p
//   mean_p |sum_k w_k n_k(p) - n(p)|^2 + c |sum_k w_k x_k(p) - x(p)|^2 + r |w|^2
//     + a mean_ps (d_s / r_s)^4 (sum_k w_k f_s(x_k(p), n_k(p)) - f_s(x(p), n(p)))^2,   sum_k w_k = 1.
// Here n and x are the vertex's posed normal and position, and n_k and x_k are the normals and positions of
// its key points. The factor with the sphere's distance d_s and radius r_s makes near and far spheres equally
// important. Some weights are negative: key points on the inner side of a curved limb extrapolate to vertices
// on the outer side. We round the weights to the steps of the file one by one. After each weight, we solve
// for the remaining weights again, so that they compensate for the rounding.
void fit_blend_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses);

}  // namespace nook::bake
