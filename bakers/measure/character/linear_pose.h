// Ambient occlusion linear in the joint rotations (Kontkanen & Aila 2006, "Ambient Occlusion for Animated
// Characters").
#pragma once

#include <memory>
#include <span>

#include "bakers/measure/character/baseline.h"

namespace nook::bake {

// AO of a vertex = dot(its coefficients, the pose's parameters) + constant, by least squares over the poses.
// Tuned by cross-validation over runs of poses: how rotations become parameters (logarithms or matrix
// entries, scaled or not), a ridge on the coefficients, and the rank to which the matrix of all vertices'
// coefficients is reduced: the best for the left-out poses, or a smaller one that costs them at most 0.5 %.
// Deterministic on any number of threads.
std::unique_ptr<PoseRegression> fit_linear_pose(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                                const AoTargets& targets);

}  // namespace nook::bake
