// Makes plausible whole-body poses. People follow the ranges and couplings of the human body. All other
// bodies use gaits and chains (animal_poses.h). If a body intersects itself or tears its skin in a pose, the
// pose is drawn again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Returns `count` poses. The same seed gives the same poses. Rest space is glTF's, with +y up. torn_by_clips
// is the share of edges that all clips of the body tear (torn_edges.h), whether the clips are fitted or not.
// Skin with few vertices stretches far at every elbow, and the clips show how far.
std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed, const RigCorrections& corrections = {},
                             double torn_by_clips = 0);

// Returns true if generations 4 and 5 (see pose_generation) give this person different poses. That is so if
// palms have several bones, or if clavicles carry the arms.
bool differs_from_generation_4(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
