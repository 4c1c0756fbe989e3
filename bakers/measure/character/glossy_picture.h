// A glossy character under a map: what specular occlusion leaves of its reflections, beside path tracing.
#pragma once

#include <cstdint>

#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/bent_study.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

struct GlossyPictureSettings {
  float roughness = 0.3f;
  std::uint32_t rays = 96;  // for each of four samples of a pixel
  int width_px = 300, height_px = 640;
  std::uint64_t seed = 1;
};

// Four panels from the front: reflections that nothing hides, S. Lagarde's form of the model's AO, the
// model's AO and bent normals, and path traced. The body is a mirror of the roughness, without colour; the
// map's mean radiance is middle grey. Throws Failure: UNSUPPORTED (the model was baked without bent normals).
bake::Picture glossy_picture(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                             const bake::Pose& pose, const GlossyMap& map,
                             const GlossyPictureSettings& settings);

}  // namespace nook::measure
