// The three presets of a bake, by the time that it spends.
#pragma once

#include <cstdint>
#include <string_view>

#include "bakers/character/bake.h"

namespace nook::bake {

enum class Preset : std::uint8_t { draft, standard, production };

struct PresetValues {
  BakeSettings settings;
  std::size_t auto_poses = 0;
  std::size_t clip_poses = 0;  // over all fitted clips together
  std::size_t max_samples_per_clip = 64;
  int single_joint_steps = 5;  // a side of the grid of rotations
};

// draft: about 20 s on two cores, for a first look. standard: within 5 minutes and 2 GB, for shipping.
// production: nearly four times the poses of standard, three times its steps, twice its rays, and 800 key
// points in place of 500.
PresetValues preset_values(Preset preset, FitMethod fit);

// Poses of each clip, so that all of them together come near the preset's number: short enough lists still
// show a whole clip, long ones do not outgrow the preset.
std::size_t samples_per_clip(const PresetValues& values, std::size_t clips);

}  // namespace nook::bake
