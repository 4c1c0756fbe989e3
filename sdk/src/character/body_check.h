// Finds bodies whose pose, place or ground is unlikely to be meant.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook {

// Bits of InstanceInput::reported, in addition to the topics of PoseNotes. A bit is set after the log has
// reported its topic. `no_update` means that AO was read before the first update. `floats` is also set once
// the body has come near its ground.
inline constexpr std::uint32_t topic_ground = 16, topic_size = 32, topic_same_place = 64,
                               topic_no_update = 128, topic_in_occluder = 256, topic_floats = 512;

// How a ground differs from the one that the host probably meant. The unit is wrong if the offset should be
// 100 times as large or as small.
enum class GroundMistake { height, turned_normal, offset_sign, both_signs, unit };

struct GroundFinding {
  bool is_wrong = false;
  // True if the body is higher above the plane than it is tall. A body that flies or climbs is this high,
  // too. So the ground is wrong only if a likely mistake explains the height exactly.
  bool floats = false;
  float share_below = 0;  // of the body, by its proxy spheres; by its bound if only the GPU has the bones
  float depth = 0;        // of the lowest of them below the plane, in metres; negative above it
  // The mistake without which the body would stand on the plane.
  GroundMistake mistake = GroundMistake::height;
  float offset = 0;  // of the plane without this mistake; for GroundMistake::height, the given one
};

// A ground is wrong if more than 5 % of the body is more than 0.3 bounding radii below it. For a human, this
// depth reaches the middle of the shin. Feet that sink in, lower steps of stairs and bodies that lie down do
// not reach as deep. For a body that is larger than people, the steps of stairs are as high as for people. So
// its ground is wrong if more than 1.5 % of the body is deeper than 0.1 radii and than 0.6 m. A ground is
// also wrong if more than 40 % of the body is below it, for example if the plane stands upright in the body.
// If only the GPU has the bones, the centre of the bound must be deeper than 0.3 of the bound's radius. The
// instance must have a ground.
GroundFinding check_ground(const Instance& instance) noexcept;

// Returns the radius of the posed body, divided by the radius of the rest pose in the same scale. Limbs can
// make it about 1.5. The result is larger if the translations are in another unit, or if bones were swapped.
// Returns 1 if only the GPU has the pose.
float relative_size(const Instance& instance) noexcept;
inline constexpr float max_relative_size = 4;

// Returns an occluder of the last update that contains the whole body, and therefore makes it black, or null.
const Occluder* occluder_around(const Scene& scene, const Instance& instance) noexcept;

// Returns true if scene.nearest_max_distance is shorter than half of the radius of every body, so that two
// bodies would have to stand in each other to be linked.
bool links_nobody(const Scene& scene) noexcept;

// Returns an instance of the same model that darkens this one from the same place, or null.
const Instance* caster_at_same_place(const Scene& scene, const Instance& instance) noexcept;

}  // namespace nook
