// Makes the levels of detail of a model from poses, at bake time. Their error is measured on other poses.
#pragma once

#include <span>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

struct LevelShare {
  float spheres = 0.5f;     // share of the model's spheres; each bone with spheres keeps at least one
  float key_points = 0.3f;  // share of the model's key points
};
inline constexpr LevelShare default_level_shares[] = {{0.5f, 0.35f}, {0.3f, 0.12f}};

// Makes one level for each share. Pass about 50 to 300 poses of model.bone_count() matrices each, for example
// the poses of the bake. Poses with an even index are used to make the level. Poses with an odd index only
// measure error_rms. The same input gives the same levels. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for
// fewer than four poses or a pose of another length.
std::vector<CharacterLevel> make_levels(const CharacterModel& model,
                                        std::span<const std::vector<Mat3x4>> poses,
                                        std::span<const LevelShare> shares = default_level_shares);

}  // namespace nook::bake
