// Finds the roles of the bones of any rig from the mesh, the hierarchy and the rest pose. Names are only a
// hint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// How much skin two bones share. For each edge of the mesh, the weight of one bone at one end is multiplied
// by the weight of the other bone at the other end. The products are summed over all edges.
struct SkinContact {
  std::uint32_t a = 0, b = 0;  // bones, a < b
  float amount = 0;
};

// Returns contacts in ascending order of bones. A bone has no contacts if no edge connects its skin to the
// skin of another bone.
std::vector<SkinContact> skin_contacts(const SkinnedMesh& mesh);

// Returns the hierarchy that the skin suggests. If a branch shares skin with a bone far from its own parent,
// and none with its ancestors, it becomes a child of that bone. For example, rigs with inverse kinematics
// keep feet and hands under their root, although they belong to the ends of limbs.
std::vector<std::int32_t> parents_by_skin(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// Pairs of bones on the two sides of a body. Some bones may have no partner.
struct BodySides {
  bool across_x = true;               // true if the sides differ in x; false if they differ in z
  float middle_m = 0;                 // position of the plane between the sides, metres
  float tolerance_m = 0;              // bones that are nearer to the plane than this belong to the middle
  std::vector<std::int32_t> partner;  // partner of each bone; itself for a bone in the middle; -1: none
};
BodySides body_sides(const SkinnedMesh& mesh, std::span<const std::int32_t> parent);

// Returns the role, side and limb number of every joint. Legs are numbered first, from front to back, and
// left before right.
std::vector<Joint> roles_by_geometry(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

}  // namespace nook::bake
