// Published object-space methods to compare with Nook. They are fitted to the same poses and measured on the
// same targets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bakers/measure/character/character_error.h"

namespace nook::lab {

// Fits ambient occlusion that is linear in the joint rotations (Kontkanen & Aila 2006, "Ambient Occlusion for
// Animated Characters"). The AO of a vertex is dot(coefficients of the vertex, parameters of the pose) +
// constant, fitted by least squares over the poses. Cross-validation over runs of poses chooses three things:
// how rotations become parameters (logarithms or matrix entries, scaled or not), the ridge on the
// coefficients, and the rank of the coefficient matrix of all vertices. The chosen rank is the smallest one
// whose error on the left-out poses is within 0.5 % of the best. The result does not depend on the number of
// threads.
std::unique_ptr<measure::PoseRegression> fit_linear_pose(const bake::SkinnedMesh& mesh,
                                                         std::span<const bake::Pose> poses,
                                                         const bake::AoTargets& targets);

// Fits ambient occlusion with clusters of poses, where each cluster has its own linear model (Kirk & Arikan
// 2007, "Real-Time Ambient Occlusion for Dynamic Character Skins"). K-means groups the poses by their joint
// parameters. In each cluster, a principal-component basis reduces the pose, and AO is linear in the reduced
// pose. The results of the clusters are blended with weights that depend on the distance of the pose to the
// cluster centres. The fits use the same weights (moving least squares).
//
// Cross-validation over runs of poses chooses how rotations become parameters, the metric of poses and the
// number of clusters. It also chooses the rank of the basis, the ridge and the width of the blend. The chosen
// model is the smallest one whose error is within 0.5 % of the best. The result depends on the seed, but not
// on the number of threads.
std::unique_ptr<measure::PoseRegression> fit_pose_clusters(const bake::SkinnedMesh& mesh,
                                                           std::span<const bake::Pose> poses,
                                                           const bake::AoTargets& targets,
                                                           std::uint64_t seed = 1);

}  // namespace nook::lab
