#include "bakers/character/pose_sets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "bakers/character/rotation.h"

namespace nook::bake {
namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

// Non-ASCII bytes of UTF-8 count as letters.
bool is_letter(char c) {
  return is_lower(c) || is_upper(c) || static_cast<unsigned char>(c) >= 0x80;
}

// Returns true if a word begins at character `i`. A word begins at a capital after a small letter (S in
// jumpStart), and at the last of several capitals before a small letter (W in UALWalk).
bool begins_word(std::string_view name, std::size_t i) {
  if (!is_upper(name[i])) return false;
  return !is_upper(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1]));
}

std::string_view without_namespace(std::string_view name) {
  name.remove_prefix(name.find_last_of("|:") + 1);  // npos + 1 is 0
  return name;
}

// Returns the length of the prefix that all names share. The prefix ends with a byte that is not a letter.
std::size_t shared_prefix(std::span<const std::string_view> names) {
  if (names.size() < 2) return 0;
  std::string_view shared = names.front();
  for (const std::string_view name : names) {
    const auto differ = std::mismatch(shared.begin(), shared.end(), name.begin(), name.end());
    shared = shared.substr(0, std::size_t(differ.first - shared.begin()));
  }
  while (!shared.empty() && is_letter(shared.back())) shared.remove_suffix(1);
  return shared.size();
}

std::string first_word(std::string_view name) {
  std::size_t i = 0;
  while (i < name.size() && !is_letter(name[i])) ++i;
  std::string word;
  for (; i < name.size() && is_letter(name[i]); ++i) {
    if (!word.empty() && begins_word(name, i)) break;
    word += is_upper(name[i]) ? char(name[i] - 'A' + 'a') : name[i];
  }
  return word;
}

}  // namespace

std::vector<std::string> clip_families(std::span<const std::string_view> names) {
  std::vector<std::string_view> own;
  for (const std::string_view name : names) own.push_back(without_namespace(name));
  const std::size_t prefix = shared_prefix(own);
  std::vector<std::string> families;
  for (const std::string_view name : own) families.push_back(first_word(name.substr(prefix)));
  return families;
}

namespace {

// Returns true if the letters of a name after the last | or : spell tpose or apose. Examples: "T-Pose",
// "t_pose", "TPose", "A-Pose", "Armature|A pose".
bool is_reference_pose(const std::string& name) {
  std::string letters;
  for (char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)))
      letters += char(std::tolower(static_cast<unsigned char>(c)));
    else if (c == '|' || c == ':')
      letters.clear();
  }
  return letters == "tpose" || letters == "apose";
}

}  // namespace

Pose turn_joints(const SkinnedMesh& mesh, std::span<const JointRotation> turns) {
  Pose pose(mesh.bones.size());
  std::vector<Mat3x4> local(mesh.bones.size());
  std::vector<char> turned(mesh.bones.size(), 0);
  for (const JointRotation& t : turns) {
    const Mat3x4& frame = mesh.bones[t.bone].frame_rest;
    local[t.bone] = local[t.bone] * (frame * rotation(t.axis_angle) * inverse_rigid(frame));
    turned[t.bone] = 1;
  }
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const std::int32_t parent = mesh.bones[b].parent;
    if (parent >= 0)
      pose[b] = turned[b] ? pose[std::size_t(parent)] * local[b] : pose[std::size_t(parent)];
    else
      pose[b] = local[b];
  }
  return pose;
}

std::vector<Pose> clip_poses(const ImportedCharacter& character, std::span<const std::size_t> clips,
                             std::size_t samples_per_clip) {
  std::vector<Pose> poses;
  poses.reserve(clips.size() * samples_per_clip);
  for (std::size_t clip : clips)
    for (std::size_t i = 0; i < samples_per_clip; ++i)
      poses.push_back(sample_clip(
          character, clip, (float(i) + 0.5f) / float(samples_per_clip) * character.clips[clip].duration_s));
  return poses;
}

std::vector<std::size_t> motion_clips(const ImportedCharacter& character) {
  std::vector<std::size_t> clips;
  for (std::size_t i = 0; i < character.clips.size(); ++i)
    if (!is_reference_pose(character.clips[i].name)) clips.push_back(i);
  std::sort(clips.begin(), clips.end(),
            [&](std::size_t a, std::size_t b) { return character.clips[a].name < character.clips[b].name; });
  return clips;
}

ClipSplit split_clips(std::span<const std::size_t> clips) {
  ClipSplit split;
  for (std::size_t i = 0; i < clips.size(); ++i)
    (i % 2 == 0 ? split.fitted : split.measured).push_back(clips[i]);
  return split;
}

ClipSplit split_families(const ImportedCharacter& character, std::span<const std::size_t> clips) {
  std::vector<std::string_view> names;
  for (const std::size_t clip : clips) names.push_back(character.clips[clip].name);
  const std::vector<std::string> families = clip_families(names);
  ClipSplit split;
  std::map<std::string, std::size_t> number;  // index of each family; its clips need not be adjacent in byte
                                              // order
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const std::size_t family = number.emplace(families[i], number.size()).first->second;
    (family % 2 == 0 ? split.fitted : split.measured).push_back(clips[i]);
  }
  return split;
}

std::vector<Pose> turned_poses(std::size_t count, float shift) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * (float(i) + shift) / float(count);
    const float c = std::cos(angle), s = std::sin(angle);
    poses.push_back({Mat3x4{{c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0}}});
  }
  return poses;
}

std::vector<std::uint32_t> posable_joints(const SkinnedMesh& mesh) {
  const std::size_t bones = mesh.bones.size(), vertices = mesh.vertex_count();
  std::vector<std::size_t> moved(bones, 0);
  std::vector<char> touches(bones);
  for (const SkinWeights& w : mesh.weights) {
    std::fill(touches.begin(), touches.end(), char(0));
    for (int s = 0; s < SkinWeights::max_bones; ++s) {
      if (w.weight[s] <= 0) continue;
      for (std::int32_t b = w.bone[s]; b >= 0 && !touches[std::size_t(b)];
           b = mesh.bones[std::size_t(b)].parent)
        touches[std::size_t(b)] = 1;
    }
    for (std::size_t b = 0; b < bones; ++b) moved[b] += std::size_t(touches[b]);
  }
  std::vector<std::uint32_t> joints;
  for (std::size_t b = 0; b < bones; ++b) {
    // Skips joints that move every vertex, because a turn of the whole body does not change AO.
    if (moved[b] > 0 && moved[b] < vertices) joints.push_back(std::uint32_t(b));
  }
  return joints;
}

std::vector<Pose> single_joint_poses(const SkinnedMesh& mesh, int steps, float range_radians) {
  std::vector<Pose> poses{Pose(mesh.bones.size())};
  const auto angle = [&](int i) {
    return steps > 1 ? range_radians * (2 * float(i) / float(steps - 1) - 1) : 0.0f;
  };
  for (std::uint32_t joint : posable_joints(mesh))
    for (int x = 0; x < steps; ++x)
      for (int y = 0; y < steps; ++y)
        for (int z = 0; z < steps; ++z) {
          if (angle(x) == 0 && angle(y) == 0 && angle(z) == 0) continue;
          const JointRotation turns[] = {
              {joint, {angle(x), 0, 0}}, {joint, {0, angle(y), 0}}, {joint, {0, 0, angle(z)}}};
          poses.push_back(turn_joints(mesh, turns));
        }
  return poses;
}

}  // namespace nook::bake
