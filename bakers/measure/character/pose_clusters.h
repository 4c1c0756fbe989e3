// Ambient occlusion by clusters of poses, each with a linear model of its own (Kirk & Arikan 2007, "Real-Time
// Ambient Occlusion for Dynamic Character Skins").
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bakers/measure/character/baseline.h"

namespace nook::bake {

// Poses are grouped by k-means in joint parameters; in each cluster a principal-component basis reduces the
// pose, AO is linear in the reduced pose, and the clusters' answers are blended by the distance of the pose
// to their centres (moving least squares: the same weights hold in the fits). Tuned by cross-validation over
// runs of poses: how rotations become parameters, the metric of poses, the number of clusters, the rank of
// the basis, a ridge and the width of the blend; of all within 0.5 % of the best, the smallest. Deterministic
// for a seed on any number of threads.
std::unique_ptr<PoseRegression> fit_pose_clusters(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                                  const AoTargets& targets, std::uint64_t seed = 1);

}  // namespace nook::bake
