// Draws the darkening by a body, computed by ray tracing and by each method.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// Writes pose_0.png, pose_1.png, ... for `count` evenly picked poses. They show a floor and a wall at 0.3 m
// under AO (above) and under a cone of light of 20 degrees (below). The columns are ray tracing, Nook,
// capsules and blobs. The baselines have the best scale for each picture. Creates the directory.
void write_world_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                          const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                          std::uint32_t rays, std::uint64_t seed);

}  // namespace nook::measure
