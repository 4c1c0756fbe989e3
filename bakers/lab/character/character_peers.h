// The published object-space alternatives, fitted on the same poses and measured on the same targets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bakers/measure/character/character_error.h"

namespace nook::lab {

// Ambient occlusion linear in the joint rotations (Kontkanen & Aila 2006, "Ambient Occlusion for Animated
// Characters"). AO of a vertex = dot(its coefficients, the pose's parameters) + constant, by least squares
// over the poses. Cross-validation over runs of poses chooses three things: how rotations become parameters
// (logarithms or matrix entries, scaled or not), a ridge on the coefficients, and the rank of the matrix of
// all vertices' coefficients. The rank is the best for the left-out poses, or a smaller one that costs them
// at most 0.5 %. Deterministic on any number of threads.
std::unique_ptr<measure::PoseRegression> fit_linear_pose(const bake::SkinnedMesh& mesh,
                                                         std::span<const bake::Pose> poses,
                                                         const bake::AoTargets& targets);

// Ambient occlusion by clusters of poses, each with its own linear model (Kirk & Arikan 2007, "Real-Time
// Ambient Occlusion for Dynamic Character Skins"). Poses are grouped by k-means in joint parameters. In each
// cluster, a principal-component basis reduces the pose, and AO is linear in the reduced pose. The distance
// of the pose to the centres blends the clusters' answers (moving least squares: the fits use the same
// weights).
//
// Cross-validation over runs of poses chooses how rotations become parameters, the metric of poses and the
// number of clusters. It also chooses the rank of the basis, a ridge and the width of the blend. It takes the
// smallest model within 0.5 % of the best. Deterministic for a seed on any number of threads.
std::unique_ptr<measure::PoseRegression> fit_pose_clusters(const bake::SkinnedMesh& mesh,
                                                           std::span<const bake::Pose> poses,
                                                           const bake::AoTargets& targets,
                                                           std::uint64_t seed = 1);

}  // namespace nook::lab
