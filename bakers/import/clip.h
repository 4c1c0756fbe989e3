// Defines clips, which are keyframed node transforms, and computes poses from them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/import/node_tree.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

struct ImportedCharacter;

enum class Interpolation { linear, step, cubic_spline };
enum class ChannelPath { translation, rotation, scale };

struct Channel {
  std::uint32_t node = 0;
  ChannelPath path = ChannelPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> time_s;  // ascending, from the clip's first key on
  std::vector<float>
      value;  // 3 or 4 (x, y, z, w) floats per key; cubic_spline: in-tangent, value, out-tangent

  int components() const { return path == ChannelPath::rotation ? 4 : 3; }
};

struct Clip {
  std::string name;  // unique in its file
  float duration_s =
      0;  // time from the first key to the last one, over all channels; the first key may be later than 0
  float start_s = 0;  // time of the first key in the file
  std::vector<Channel> channels;
};

// Overwrites the transforms that the clip animates, and does not change the others. `time_s` is relative to
// the clip's first key, and is clamped to the clip's duration.
void apply_clip(const Clip& clip, float time_s, std::vector<Trs>& locals);

// Returns bone matrices from rest space to world, rigid or uniformly scaled. The function removes shear and
// non-uniform scale. If `deviation` is not null, it receives the relative size of the removed part for each
// bone.
Pose bone_matrices(const ImportedCharacter& character, const std::vector<Trs>& locals,
                   std::vector<double>* deviation);

Pose sample_clip(const ImportedCharacter& character, std::size_t clip, float time_s);

Pose rest_pose(const ImportedCharacter& character);

// If no clip has this name, fails with INVALID_ARGUMENT. The message lists the existing names.
std::size_t find_clip(const ImportedCharacter& character, std::string_view name);

}  // namespace nook::bake
