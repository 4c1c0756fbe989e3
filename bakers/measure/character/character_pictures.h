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

// Writes pose_0.png, pose_1.png, ... for `count` poses that are picked at even intervals. Each picture has
// six panels: traced AO, predicted AO and |error| x 4 from the front, then the same three from the back. Also
// writes rms.png. It shows vertex_rms x 4, which is the error over all poses, on the rest pose from the front
// and the back. Creates the directory.
void write_pictures(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed);

// Draws two bodies that darken themselves and each other. The panels show traced AO, predicted AO and |error|
// x 4, obliquely from the front and then from behind. Creates the file's directory.
void write_pair_picture(const std::filesystem::path& path, const bake::SkinnedMesh& mesh,
                        const CharacterModel& model, const BodyPair& pair, const CasterStudy& study);

struct GlossyPictureSettings {
  float roughness = 0.3f;
  std::uint32_t rays = 96;  // rays for each of the four samples of a pixel
  int width_px = 300, height_px = 640;
  std::uint64_t seed = 1;
};

// Draws four panels from the front. They show the reflections without occlusion, then with Lagarde's formula
// and the model's AO, then with the model's AO and bent normals, and finally path traced. The body is a
// colourless mirror with the given roughness. Middle grey stands for the mean radiance of the map. Throws
// Failure: UNSUPPORTED (the model was baked without bent normals).
bake::Picture glossy_picture(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                             const bake::Pose& pose, const GlossyMap& map,
                             const GlossyPictureSettings& settings);

}  // namespace nook::measure
