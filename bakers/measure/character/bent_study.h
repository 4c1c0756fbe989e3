// Measures bent normals and specular occlusion of a character against ray tracing, beside the plain normal
// and S. Lagarde's formula with the same AO.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/nnao/specular_fit.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/specular_visibility.h"
#include "sdk/src/character/model.h"
#include "sdk/src/nnao/lighting.h"

namespace nook::measure {

// A posed character with the AO and bent normals that its model gives to a host. Each array has one entry per
// welded vertex, in world space and metres. Normals have unit length.
struct BentBody {
  std::vector<Vec3> position, normal, bent;
  std::vector<float> ao;
};

// An occluded direction turns with its vertex, as the vertex shader of a host skins it. Throws Failure:
// UNSUPPORTED (the model was baked without bent normals).
BentBody bent_body(const bake::SkinnedMesh& mesh, const CharacterModel& model, const bake::Pose& pose);

// The numbers of nook_scene_specular_occlusion on the CPU.
nook::nnao::SpecularNumbers character_specular_numbers();

// Returns the text of shaders/character/specular_numbers.h, which holds the numbers.
std::string character_specular_header(const nook::nnao::SpecularNumbers& numbers);

// A map that the character is glossy under.
struct GlossyMap {
  std::string name;
  bake::Environment light;
};

struct BentStudy {
  std::size_t points = 600;  // welded vertices of each pose, each with a viewer that nothing hides
  std::uint32_t rays = 512;  // for AO and the bent normal of a point; a reflection takes an eighth, twice
  std::uint64_t seed = 1;
};

// Rows of the methods "normal" (in place of the bent normal), "nook", and "reference", which has the traced
// AO and bent normal: method, map ("visibility", under uniform light, or a map's name), poses, points;
// angle_median, angle_mean and angle_p90 (degrees, where the traced AO is below 0.7); specular_mse,
// lagarde_mse and specular_ratio, and both errors for each roughness of 0.1 to 0.9. Under a map, the errors
// compare radiance, in units of the map's mean radiance. Each error is the product of the errors against two
// references with their own rays, so it has no noise floor. Throws Failure: UNSUPPORTED (the model was baked
// without bent normals), CANCELLED.
nlohmann::ordered_json bent_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                 std::span<const bake::Pose> poses, std::span<const GlossyMap> maps,
                                 const BentStudy& study, const bake::Progress& progress = {});

// The points of the rows without maps, to which `nook train bent` fits the numbers of the shader. The
// network's pixels have the model's AO and bent normal. Throws as bent_rows does.
std::vector<bake::nnao::SpecularSample> bent_samples(const bake::SkinnedMesh& mesh,
                                                     const CharacterModel& model,
                                                     std::span<const bake::Pose> poses,
                                                     const BentStudy& study,
                                                     const bake::Progress& progress = {});

// Returns the mean over all directions and channels.
double mean_radiance(const bake::Environment& map);

// A map of a few texels without its suns: each texel is the mean of the texels that it covers.
bake::Environment coarse_map(const bake::Environment& with_suns, std::uint32_t width);

}  // namespace nook::measure
