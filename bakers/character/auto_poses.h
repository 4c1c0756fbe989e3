// Plausible whole-body poses: ranges and couplings of the human body for people, gaits and chains
// (animal_poses.h) for all other bodies. Poses in which the body runs through itself or tears its skin are
// drawn again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Returns count poses; the same seed gives the same poses. Rest space of glTF: +y is up.
// torn_by_clips: the share of edges that the body's own clips tear (torn_edges.h), whether they are fitted or
// not. Skin of few vertices stretches far at every elbow, and clips show how far.
std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed, const RigCorrections& corrections = {},
                             double torn_by_clips = 0);

// Returns whether generations 4 and 5 give a person different poses: where the palms are parted, or clavicles
// carry the arms.
bool differs_from_generation_4(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
