// Finds bodies whose pose, place or ground is unlikely to be meant.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook {

// Bits of InstanceInput::reported, in addition to the topics of PoseNotes. A bit is set after the log has
// reported the ground, the size or the place of the instance, or that AO was read before the first update.
inline constexpr std::uint32_t topic_ground = 16, topic_size = 32, topic_same_place = 64,
                               topic_no_update = 128;

// How a ground differs from the one that the host probably meant.
enum class GroundMistake { height, turned_normal, offset_sign, both_signs };

struct GroundFinding {
  bool is_wrong = false;
  float share_below = 0;  // share of the proxy spheres below the ground; estimated from the bound if only the
                          // GPU has the bones
  float depth = 0;        // depth of the lowest point below the plane, in metres
  // The mistake without which the body would stand on the plane.
  GroundMistake mistake = GroundMistake::height;
};

// A ground is wrong if more than 5 % of the body is more than 0.3 bounding radii below it. For a human, this
// depth reaches the middle of the shin. Feet that sink in, lower steps of stairs and bodies that lie down do
// not reach as deep. A ground is also wrong if more than 40 % of the body is below it, for example if the
// plane stands upright in the body. If only the GPU has the bones, the centre of the bound must be deeper
// than 0.3 of the bound's radius. The instance must have a ground.
GroundFinding check_ground(const Instance& instance) noexcept;

// Returns the radius of the posed body, divided by the radius of the rest pose in the same scale. Limbs can
// make it about 1.5. The result is larger if the translations are in another unit, or if bones were swapped.
// Returns 1 if only the GPU has the pose.
float relative_size(const Instance& instance) noexcept;
inline constexpr float max_relative_size = 4;

// Returns an instance of the same model that darkens this one from the same place, or null.
const Instance* caster_at_same_place(const Scene& scene, const Instance& instance) noexcept;

}  // namespace nook
