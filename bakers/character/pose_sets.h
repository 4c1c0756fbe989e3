// Chooses the poses that a character is baked on and measured on. The same seed gives the same poses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/import/gltf.h"

namespace nook::bake {

// Guesses from the names of clips which clips are parts of one motion.

// Returns the family of each clip: the first word of its name in lower case. A word ends at anything that is
// not a letter, and before a capital that begins another word. For example, Jump_Land, JumpStart, jump.002
// and JUMP 3 all belong to the family "jump". Text before the last | or : names an armature or a namespace
// and is ignored. A prefix that all names share is also ignored, up to its last byte that is not a letter:
// Robot_Walk and Robot_Run belong to "walk" and "run". All names without a letter form one family with an
// empty name.
std::vector<std::string> clip_families(std::span<const std::string_view> names);

// A rotation of one joint about its own rest axes, radians.
struct JointRotation {
  std::uint32_t bone = 0;
  Vec3 axis_angle;  // joint frame; the length is the angle
};

// Returns the pose in which the given joints are turned and all other joints rest. If a joint is listed
// twice, both turns are applied.
Pose turn_joints(const SkinnedMesh& mesh, std::span<const JointRotation> turns);

// Samples each clip at the times (i + 0.5) / samples of its duration.
std::vector<Pose> clip_poses(const ImportedCharacter& character, std::span<const std::size_t> clips,
                             std::size_t samples_per_clip);

// Returns the clips of a character that show motion, in byte order of their names. These are all clips except
// T- and A-poses, which are recognised by their names.
std::vector<std::size_t> motion_clips(const ImportedCharacter& character);

// Clips 0, 2, ... are for fitting. The other clips are for measuring on unseen clips.
struct ClipSplit {
  std::vector<std::size_t> fitted, measured;
};
ClipSplit split_clips(std::span<const std::size_t> clips);
// Splits by families (clip_families() above), in the order of each family's first clip, so that all parts of
// one motion are on the same side. If there is only one family, no clip is left for measuring.
ClipSplit split_families(const ImportedCharacter& character, std::span<const std::size_t> clips);

// Returns poses of an object with one bone, turned about the vertical axis to `count` evenly spaced
// directions. `shift` turns all directions by this share of the step between two directions.
std::vector<Pose> turned_poses(std::size_t count, float shift);

// Keeps at most max_count items at even intervals; 0 keeps all.
template <class Item>
void thin_out(std::vector<Item>& items, std::size_t max_count) {
  if (max_count == 0 || items.size() <= max_count) return;
  std::vector<Item> kept;
  for (std::size_t i = 0; i < max_count; ++i) kept.push_back(std::move(items[i * items.size() / max_count]));
  items = std::move(kept);
}

// Returns the joints that move some but not all vertices.
std::vector<std::uint32_t> posable_joints(const SkinnedMesh& mesh);

// Turns each posable joint alone, on a steps^3 grid of Euler rotations (x, then y, then z about its local
// axes) over +-range radians. This is the paper's training set (slide 9). It contains the rest pose once.
std::vector<Pose> single_joint_poses(const SkinnedMesh& mesh, int steps, float range_radians);

}  // namespace nook::bake
