// Finds the palms of a rig, and the axes about which its fingers curl.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// A point of the body in rest space. If `bone` is -1, there is no such point.
struct BodyPoint {
  std::int32_t bone = -1;
  Vec3 point;
};

// Returns true for a palm bone if several palm bones hang side by side on one forearm, for example one per
// finger. They have no common wrist. If each turned about its own joint, they would separate.
std::vector<char> parted_palms(std::span<const Joint> joints, const BodyTree& tree);

// For the left and the right hand, returns the centre of the knuckles, or the wrist if the hand has no
// knuckles.
std::array<BodyPoint, 2> palms(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree);

// A hand in its rest pose. Directions have unit length. They are zero if the rig has no fingers.
struct HandFrame {
  Vec3 knuckles;  // centre of the knuckles, or the wrist if there are none
  Vec3 along;     // from the wrist to the knuckles
  Vec3 across;    // towards the thumb's side, perpendicular to along
  Vec3 palm;      // the direction in which the palm faces
};
HandFrame hand_frame(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                     std::size_t wrist, Vec3 up);

// Returns the rotation of a finger's joint as a rotation vector. `curl` is 0 for a stretched finger and 1 for
// a fist.
Vec3 finger_turn(const Joint& joint, Vec3 curl_axis, float curl);

// Returns true for fingers and thumbs that carry an object. For example, a club may be skinned to a finger.
// It reaches much farther than a finger and would swing with the finger, so automatic poses do not move such
// fingers.
std::vector<char> laden_fingers(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree);

// Returns the curl axis of each joint of fingers and thumbs, as a unit vector in rest space; zero for other
// joints. Fingers curl about the axis across the knuckles, towards the palm.
std::vector<Vec3> curl_axes(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                            Vec3 up);

}  // namespace nook::bake
