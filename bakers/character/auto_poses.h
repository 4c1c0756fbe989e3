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

// Knowledge of a character beside its mesh.
struct KnownMotion {
  // Poses of clips that the model is fitted to. The poses of bodies other than people's are mixed with them,
  // so that the clips' ranges and couplings carry over.
  std::span<const Pose> poses;
  // The share of edges that the body's own clips tear (torn_edges.h), whether they are fitted or not. Skin of
  // few vertices stretches far at every elbow, and clips show how far.
  double torn_share = 0;
};

// count poses; the same seed gives the same poses. Rest space of glTF: +y is up.
std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed, const RigCorrections& corrections = {},
                             const KnownMotion& known = {});

}  // namespace nook::bake
