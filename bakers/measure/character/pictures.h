// The error of a model drawn on the body.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/casters.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// pose_0.png, pose_1.png, ... of `count` poses, evenly picked: front traced, front predicted, front |error| x
// 4, then the same from the back. rms.png: the error of all poses (vertex_rms) x 4 on the rest pose, front
// and back. The directory is created.
void write_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed);

// Two bodies, each darkened by itself and the other, obliquely from before: traced, predicted, |error| x 4,
// then the same from behind. The file's directory is created.
void write_pair_picture(const std::filesystem::path& path, const bake::SkinnedMesh& mesh,
                        const CharacterModel& model, const bake::BodyPair& pair,
                        const bake::CasterStudy& study);

}  // namespace nook::measure
