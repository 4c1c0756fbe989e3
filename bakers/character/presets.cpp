#include "bakers/character/presets.h"

#include <algorithm>

namespace nook::bake {

PresetValues preset_values(Preset preset, FitMethod fit) {
  // Steps of mini-batches are cheap, rounds of block descent are not.
  const bool paper = fit == FitMethod::paper;
  PresetValues v;
  v.settings.fit = fit;
  switch (preset) {
    case Preset::draft:
      v.settings.rays = 16;
      v.settings.steps = paper ? 3 : 1500;
      v.auto_poses = 300;
      v.clip_poses = 200;
      v.single_joint_steps = 3;
      break;
    case Preset::standard:
      // Few rays on many poses: the noise of a target averages out over the poses, what no pose shows is
      // never learned.
      v.settings.rays = 16;
      v.settings.steps = paper ? 20 : 20000;
      v.auto_poses = 2700;
      v.clip_poses = 1100;
      break;
    case Preset::production:
      v.settings.rays = 32;
      v.settings.steps = paper ? 100 : 60000;
      v.auto_poses = 10000;
      v.clip_poses = 4000;
      if (!paper) {
        // More key points have lower errors (docs/character.md); an update takes a fifth longer.
        v.settings.key_points = 800;
        v.settings.spheres = 100;
      }
      // Few clips keep their share of the poses.
      v.max_samples_per_clip = 256;
      break;
  }
  return v;
}

std::size_t samples_per_clip(const PresetValues& values, std::size_t clips) {
  return clips == 0 ? 0
                    : std::clamp<std::size_t>((values.clip_poses + clips / 2) / clips, 4,
                                              values.max_samples_per_clip);
}

}  // namespace nook::bake
