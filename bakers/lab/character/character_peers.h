// Published object-space methods that Nook is compared with. They are fitted to the same poses as Nook, and
// measured on the same targets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bakers/measure/character/character_error.h"

namespace nook::lab {

// Fits ambient occlusion that is linear in the joint rotations (Kontkanen & Aila 2006, "Ambient Occlusion for
// Animated Characters"). The AO of a vertex is dot(coefficients of the vertex, parameters of the pose) +
// constant, fitted by least squares over the poses. Cross-validation over runs of poses chooses three things.
// The first is how rotations are converted to parameters: logarithms or matrix entries, scaled or not. The
// second is the ridge (L2) regularisation of the coefficients. The third is the rank of the matrix that
// contains the coefficients of all vertices. The chosen rank is the smallest one whose error on the left-out
// poses is within 0.5 % of the lowest error. The result does not depend on the number of threads.
std::unique_ptr<measure::PoseRegression> fit_linear_pose(const bake::SkinnedMesh& mesh,
                                                         std::span<const bake::Pose> poses,
                                                         const bake::AoTargets& targets);

// Fits ambient occlusion with clusters of poses, where each cluster has its own linear model (Kirk & Arikan
// 2007, "Real-Time Ambient Occlusion for Dynamic Character Skins"). K-means groups the poses by their joint
// parameters. In each cluster, a principal-component basis reduces the pose, and AO is linear in the reduced
// pose. The results of the clusters are blended with weights that depend on the distance of the pose to the
// cluster centres. The fits use the same weights (moving least squares).
//
// Cross-validation over runs of poses chooses how rotations are converted to parameters, the distance metric
// for poses, and the number of clusters. It also chooses the rank of the basis, the ridge regularisation and
// the width of the blend. The chosen model is the smallest one whose error is within 0.5 % of the lowest
// error. The result depends on the seed, but not on the number of threads.
std::unique_ptr<measure::PoseRegression> fit_pose_clusters(const bake::SkinnedMesh& mesh,
                                                           std::span<const bake::Pose> poses,
                                                           const bake::AoTargets& targets,
                                                           std::uint64_t seed = 1);

}  // namespace nook::lab
