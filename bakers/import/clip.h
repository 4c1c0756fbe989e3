// Clips: keyframed node transforms, and the poses they give.
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
  std::string name;      // unique in its file
  float duration_s = 0;  // last key of all channels minus the first: files may begin later than 0
  float start_s = 0;     // the first key on the file's own time line
  std::vector<Channel> channels;
};

// Overwrites what the clip animates and leaves the rest. Time counts from the clip's first key and is clamped
// to its length.
void apply_clip(const Clip& clip, float time_s, std::vector<Trs>& locals);

// Returns bone matrices from rest space to world, rigid or uniformly scaled. Shear and uneven scale are
// removed, and `deviation` (may be null) receives how much each bone had, relative.
Pose bone_matrices(const ImportedCharacter& character, const std::vector<Trs>& locals,
                   std::vector<double>* deviation);

Pose sample_clip(const ImportedCharacter& character, std::size_t clip, float time_s);

Pose rest_pose(const ImportedCharacter& character);

// Fails with INVALID_ARGUMENT and lists the names that exist.
std::size_t find_clip(const ImportedCharacter& character, std::string_view name);

}  // namespace nook::bake
