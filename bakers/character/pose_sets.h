// Which poses a character is baked on and measured on. All are deterministic for a seed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/import/gltf.h"

namespace nook::bake {

// Which clips are parts of one motion, as far as their names tell.

// Returns the family of each clip: the first word of its name in lower case. A word ends at anything that is
// not a letter and before a capital that begins another: Jump_Land, JumpStart, jump.002 and JUMP 3 are all of
// "jump". What stands before the last | or : is the name of an armature or of a namespace and does not count,
// and neither does what all names begin with, up to a byte that is no letter: Robot_Walk and Robot_Run are of
// "walk" and "run". Names without a letter say nothing, so that all of them are one family, whose name is
// empty.
std::vector<std::string> clip_families(std::span<const std::string_view> names);

// A rotation of one joint about its own rest axes, radians.
struct JointRotation {
  std::uint32_t bone = 0;
  Vec3 axis_angle;  // joint frame; length is the angle
};

// The pose in which the given joints are turned and all others rest; a joint given twice turns twice.
Pose turn_joints(const SkinnedMesh& mesh, std::span<const JointRotation> turns);

// Times (i + 0.5) / samples of each clip's duration.
std::vector<Pose> clip_poses(const ImportedCharacter& character, std::span<const std::size_t> clips,
                             std::size_t samples_per_clip);

// Clips of a character that show motion: all but T- and A-poses (by name), in byte order of their names.
std::vector<std::size_t> motion_clips(const ImportedCharacter& character);

// Every second one: index 0, 2, ... are for fitting, the others for measuring (design, unseen clips).
struct ClipSplit {
  std::vector<std::size_t> fitted, measured;
};
ClipSplit split_clips(std::span<const std::size_t> clips);
// The same with families (clip_families() above) in the order of their first clips, so that no two parts of
// one motion are on both sides. With one family nothing is measured.
ClipSplit split_families(const ImportedCharacter& character, std::span<const std::size_t> clips);

// An object of one bone, turned about the vertical axis to `count` directions, evenly; `shift` of a step.
std::vector<Pose> turned_poses(std::size_t count, float shift);

// Keeps at most so many items, evenly picked; 0 keeps all.
template <class Item>
void thin_out(std::vector<Item>& items, std::size_t max_count) {
  if (max_count == 0 || items.size() <= max_count) return;
  std::vector<Item> kept;
  for (std::size_t i = 0; i < max_count; ++i) kept.push_back(std::move(items[i * items.size() / max_count]));
  items = std::move(kept);
}

// Joints that move some but not all vertices.
std::vector<std::uint32_t> posable_joints(const SkinnedMesh& mesh);

// Each such joint alone on a steps^3 grid of Euler rotations (x, then y, then z about its local axes) over
// +-range radians (the paper's training set, slide 9). The rest pose is in it once.
std::vector<Pose> single_joint_poses(const SkinnedMesh& mesh, int steps, float range_radians);

}  // namespace nook::bake
