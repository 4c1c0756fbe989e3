// Makes plausible whole-body poses. Poses of people follow the ranges and couplings of the human body. Poses
// of all other bodies are made from gaits and chains (animal_poses.h). If a body intersects itself or tears
// its skin in a pose, the pose is drawn again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Returns `count` poses. The same seed gives the same poses. Rest space uses the axes of glTF, with +y up.
// torn_by_clips is the share of edges that all clips of the body tear (torn_edges.h), including clips that
// are not fitted. It shows how much stretching is normal for this body, because a skin with few vertices
// stretches far at every elbow.
std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed, const RigCorrections& corrections = {},
                             double torn_by_clips = 0);

// Returns true if generations 4 and 5 (see pose_generation) give this person different poses. This is the
// case if the palms have several bones, or if clavicles carry the arms.
bool differs_from_generation_4(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
