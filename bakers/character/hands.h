// The palms of a rig, and the axes about which its fingers curl.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bakers/character/body_tree.h"

namespace nook::bake {

// A point of the body, rest space; bone -1: there is none.
struct BodyPoint {
  std::int32_t bone = -1;
  Vec3 point;
};

// Of the left and the right hand: the middle of the knuckles, or the wrist where there are none.
std::array<BodyPoint, 2> palms(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree);

// Of each finger and thumb, of unit length in rest space; zero for other joints. Fingers curl towards the
// palm: about the axis across them, on the side that the thumb is on.
std::vector<Vec3> curl_axes(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                            Vec3 up);

}  // namespace nook::bake
