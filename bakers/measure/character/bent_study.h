// Compares a character's bent normals and specular occlusion with ray tracing. The baselines are the plain
// normal and S. Lagarde's formula with the same AO.
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

// A posed character, with the AO and the bent normals that a host gets from its model. Each array has one
// entry per welded vertex. Positions are in world space, in metres. Normals have unit length.
struct BentBody {
  std::vector<Vec3> position, normal, bent;
  std::vector<float> ao;
};

// Skins the occluded direction of each vertex in the same way as a host's vertex shader. Throws Failure:
// UNSUPPORTED (the model was baked without bent normals).
BentBody bent_body(const bake::SkinnedMesh& mesh, const CharacterModel& model, const bake::Pose& pose);

// Returns the weights of the shader function nook_scene_specular_occlusion, for use on the CPU.
nook::nnao::SpecularNumbers character_specular_numbers();

// Returns the text of shaders/character/specular_numbers.h, which holds these weights.
std::string character_specular_header(const nook::nnao::SpecularNumbers& numbers);

// An environment map that lights a glossy character.
struct GlossyMap {
  std::string name;
  bake::Environment light;
};

struct BentStudy {
  // Welded vertices per pose; each is seen from a random viewer with a free line of sight.
  std::size_t points = 600;
  std::uint32_t rays = 512;  // per point, for AO and bent normal; each of the two references of a reflection
                             // uses an eighth of these rays
  std::uint64_t seed = 1;
};

// Returns a row for each method. The method "normal" uses the plain normal in place of the bent normal. The
// method "nook" uses the model. The method "reference" uses the traced AO and bent normal. Each row has these
// keys: method; map, which is "visibility" for uniform light and otherwise the name of a map; poses and
// points; angle_median, angle_mean and angle_p90, in degrees, measured where the traced AO is below 0.7;
// specular_mse, lagarde_mse and specular_ratio; and specular_mse and lagarde_mse for each roughness from 0.1
// to 0.9. Under a map, the errors are differences of radiance, in units of the map's mean radiance. Two
// references are traced with different rays. Each squared error is the product of the errors against these
// two references, so that it has no noise floor. Throws Failure: UNSUPPORTED (the model was baked without
// bent normals), CANCELLED.
nlohmann::ordered_json bent_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                 std::span<const bake::Pose> poses, std::span<const GlossyMap> maps,
                                 const BentStudy& study, const bake::Progress& progress = {});

// Returns the points that bent_rows measures under uniform light. `nook train bent` fits the weights of the
// shader to these points. The inputs of the fitted network are the AO and the bent normal of the model.
// Throws the same failures as bent_rows.
std::vector<bake::nnao::SpecularSample> bent_samples(const bake::SkinnedMesh& mesh,
                                                     const CharacterModel& model,
                                                     std::span<const bake::Pose> poses,
                                                     const BentStudy& study,
                                                     const bake::Progress& progress = {});

// Returns the mean radiance of the map over all directions and channels.
double mean_radiance(const bake::Environment& map);

// Returns a low-resolution copy of the map without its suns. Each texel is the mean of the texels of
// `with_suns` that it covers.
bake::Environment coarse_map(const bake::Environment& with_suns, std::uint32_t width);

}  // namespace nook::measure
