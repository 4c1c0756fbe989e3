// Finds the roles of the bones of any rig from the mesh, the hierarchy and the rest pose. Names are only a
// hint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// How much skin two bones share: the product of their weights at the two ends of an edge, summed over all
// edges.
struct SkinContact {
  std::uint32_t a = 0, b = 0;  // bones, a < b
  float amount = 0;
};

// Returns contacts in ascending order of bones. A bone has no contact if no edge connects its part of the
// mesh to another part.
std::vector<SkinContact> skin_contacts(const SkinnedMesh& mesh);

// Returns the hierarchy that the skin suggests. If a branch shares skin with a bone far from its own parent,
// and none with its ancestors, it becomes a child of that bone. Rigs with inverse kinematics keep feet and
// hands at their root, but they belong to the ends of the limbs.
std::vector<std::int32_t> parents_by_skin(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// Pairs of bones on the two sides of a body. The body may be asymmetric in some bones.
struct BodySides {
  bool across_x = true;               // the sides differ in x; otherwise in z
  float middle_m = 0;                 // position of the plane between the sides, metres
  float tolerance_m = 0;              // bones that are nearer to the plane than this belong to the middle
  std::vector<std::int32_t> partner;  // partner of each bone; for a bone in the middle, the bone itself; -1:
                                      // none
};
BodySides body_sides(const SkinnedMesh& mesh, std::span<const std::int32_t> parent);

// Sets the side and the limb number of every joint. Legs are numbered first, from front to back, left before
// right.
std::vector<Joint> roles_by_geometry(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
