// Finds the palms of a rig, and the axes about which its fingers curl.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// A point of the body, rest space; bone -1: there is none.
struct BodyPoint {
  std::int32_t bone = -1;
  Vec3 point;
};

// True for the bones of a palm that hang side by side on one forearm, such as one for each finger. They have
// no wrist to turn about, and would part from each other if each turned about its own joint.
std::vector<char> parted_palms(std::span<const Joint> joints, const BodyTree& tree);

// Returns for the left and the right hand the middle of the knuckles, or the wrist if the hand has no
// knuckles.
std::array<BodyPoint, 2> palms(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree);

// A hand in its rest pose. Directions have unit length and are zero where the rig has no fingers.
struct HandFrame {
  Vec3 knuckles;  // their middle, or the wrist where there are none
  Vec3 along;     // from the wrist to the knuckles
  Vec3 across;    // towards the thumb's side, perpendicular to along
  Vec3 palm;      // to where the palm faces
};
HandFrame hand_frame(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                     std::size_t wrist, Vec3 up);

// The turn of a finger's joint whose curl is 0 stretched and 1 in a fist.
Vec3 finger_turn(const Joint& joint, Vec3 curl_axis, float curl);

// True for fingers and thumbs that hold a thing: a club that a rig weights to a finger reaches much farther
// than a finger does, and would swing with it. Such fingers stay still.
std::vector<char> laden_fingers(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree);

// Of each finger and thumb, of unit length in rest space; zero for other joints. Fingers curl towards the
// palm: about the axis across them, on the side that the thumb is on.
std::vector<Vec3> curl_axes(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                            Vec3 up);

}  // namespace nook::bake
