// Draws pictures of a character: the error of its model on the body, and its specular occlusion beside path
// tracing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/bent_study.h"
#include "bakers/measure/character/caster_error.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// pose_0.png, pose_1.png, ... of `count` poses, evenly picked: front traced, front predicted, front |error| x
// 4, then the same from the back. rms.png: the error of all poses (vertex_rms) x 4 on the rest pose, front
// and back. The directory is created.
void write_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed);

// Draws two bodies that darken themselves and each other, obliquely from the front: traced, predicted,
// |error| x 4, then the same from behind. The file's directory is created.
void write_pair_picture(const std::filesystem::path& path, const bake::SkinnedMesh& mesh,
                        const CharacterModel& model, const BodyPair& pair, const CasterStudy& study);

struct GlossyPictureSettings {
  float roughness = 0.3f;
  std::uint32_t rays = 96;  // for each of four samples of a pixel
  int width_px = 300, height_px = 640;
  std::uint64_t seed = 1;
};

// Draws four panels from the front: reflections without occlusion, with S. Lagarde's formula and the model's
// AO, with the model's AO and bent normals, and path traced. The body is a mirror of the roughness, without
// colour; the map's mean radiance is middle grey. Throws Failure: UNSUPPORTED (the model was baked without
// bent normals).
bake::Picture glossy_picture(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                             const bake::Pose& pose, const GlossyMap& map,
                             const GlossyPictureSettings& settings);

}  // namespace nook::measure
