// The roles of bones of any rig, read from the mesh, the hierarchy and the rest pose; names are a hint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// The skin that two bones share: the product of their weights at both ends of an edge, summed over edges.
struct SkinContact {
  std::uint32_t a = 0, b = 0;  // bones, a < b
  float amount = 0;
};

// In ascending order of bones. A bone whose part of the mesh touches no other by an edge has none.
std::vector<SkinContact> skin_contacts(const SkinnedMesh& mesh);

// The hierarchy by which the skin hangs together. A branch that shares skin with a bone far from its own
// parent, and none with its parents, hangs on that bone. Rigs keep feet and hands of inverse kinematics at
// their root, and these belong to the limbs that they end.
std::vector<std::int32_t> parents_by_skin(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// Partners on the two sides of a body, which need not be symmetric in all its bones.
struct BodySides {
  bool across_x = true;               // the sides differ in x; otherwise in z
  float middle_m = 0;                 // where the plane between the sides is, metres
  float tolerance_m = 0;              // bones nearer to the plane than this are in the middle
  std::vector<std::int32_t> partner;  // of each bone; itself in the middle of the body, -1: none
};
BodySides body_sides(const SkinnedMesh& mesh, std::span<const std::int32_t> parent);

// Side and limb number of every joint are set; legs are numbered first, from the front to the back, left
// before right.
std::vector<Joint> roles_by_geometry(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
