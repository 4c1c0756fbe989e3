// Draws pictures of a character. They show the error of its model on the body, and compare its specular
// occlusion with path tracing.
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

// Writes pose_0.png, pose_1.png, ... for `count` evenly picked poses. Each shows the front traced, the front
// predicted and the front |error| x 4, then the same from the back. Also writes rms.png, which shows the
// error over all poses (vertex_rms) x 4 on the rest pose, from the front and the back. Creates the directory.
void write_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed);

// Draws two bodies that darken themselves and each other. The panels show traced, predicted and |error| x 4
// obliquely from the front, then the same from behind. Creates the file's directory.
void write_pair_picture(const std::filesystem::path& path, const bake::SkinnedMesh& mesh,
                        const CharacterModel& model, const BodyPair& pair, const CasterStudy& study);

struct GlossyPictureSettings {
  float roughness = 0.3f;
  std::uint32_t rays = 96;  // for each of the four samples of a pixel
  int width_px = 300, height_px = 640;
  std::uint64_t seed = 1;
};

// Draws four panels from the front. They show reflections without occlusion, with Lagarde's formula and the
// model's AO, with the model's AO and bent normals, and path traced. The body is a colourless mirror with the
// given roughness. The map's mean radiance is shown as middle grey. Throws Failure: UNSUPPORTED (the model
// was baked without bent normals).
bake::Picture glossy_picture(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                             const bake::Pose& pose, const GlossyMap& map,
                             const GlossyPictureSettings& settings);

}  // namespace nook::measure
