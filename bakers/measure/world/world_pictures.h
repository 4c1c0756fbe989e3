// Draws the darkening by a body, computed by ray tracing and by each method.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// Writes pose_0.png, pose_1.png, ... for `count` poses that are picked at even intervals. Each picture shows
// a floor, and a wall 0.3 m behind the body. The upper row shows AO, and the lower row a cone of light of 20
// degrees. The columns are ray tracing, Nook, capsules and blobs. Each baseline uses its best scale in each
// picture. Creates the directory.
void write_world_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                          const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                          std::uint32_t rays, std::uint64_t seed);

}  // namespace nook::measure
