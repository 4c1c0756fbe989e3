#include "bakers/character/refit_vertices.h"

#include <algorithm>

#include "bakers/character/blend_fit.h"
#include "bakers/character/export_model.h"
#include "bakers/character/initialise.h"
#include "bakers/character/linear_fit.h"
#include "bakers/import/skinning.h"

namespace nook::bake {
namespace {

constexpr std::size_t max_candidates = 40;  // key points that a vertex may use, as in a bake
constexpr std::uint32_t rest_rays = 1024;

LinearLayerFit fitted_layer(const CharacterModel& model, const FitState& state, const SkinnedMesh& mesh,
                            std::span<const Vec3> normal, const TrainingSet& set) {
  Candidates candidates;
  candidates.count = std::min(max_candidates, model.key_points.size());
  NearKeyPoints near = nearest_key_points(mesh, normal, model.key_points, candidates.count);
  candidates.key_point = std::move(near.key_point);
  candidates.nearness = std::move(near.nearness);
  LinearFitSettings settings;
  settings.entries = model.influences;
  return fit_linear_layer(shadows_of(state, set.poses), state.structure.padded_count(), set, candidates,
                          settings);
}

// Copies all that is the same for each mesh of the rig: also the caster weights, and the places where key
// points take the shadow of casters.
void take_rig(const CharacterModel& model, CharacterModel& out) {
  out.kernel = model.kernel;
  out.bone_names = model.bone_names;
  out.spheres = model.spheres;
  out.key_points = model.key_points;
  out.levels = model.levels;
  out.world_casters = model.world_casters;
  out.bounding_radius = model.bounding_radius;
  out.bounding_centre = model.bounding_centre;
  out.root_bone = model.root_bone;
  out.recipe = model.recipe;
}

}  // namespace

CharacterModel refit_vertices(const CharacterModel& model, const SkinnedMesh& mesh,
                              std::span<const Pose> poses, const RefitSettings& settings,
                              const Progress& progress) {
  TrainingSet set;
  set.poses.assign(poses.begin(), poses.end());
  set.targets = trace_character_ao(mesh, poses, settings.rays, settings.seed, progress);
  set.vertex_weight.assign(mesh.vertex_count(), 1.0f);
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);

  FitState state = state_of_model(model);
  state.linear = fitted_layer(model, state, mesh, normal, set);
  const std::vector<Pose> rest{Pose(mesh.bones.size())};
  const AoTargets rest_ao = trace_character_ao(mesh, rest, rest_rays, settings.seed);
  std::vector<float> static_ao;
  for (const std::uint16_t v : rest_ao.row(0)) static_ao.push_back(float(v) * AoTargets::scale);
  CharacterModel out = export_model(state, mesh, area, normal, static_ao);
  take_rig(model, out);
  fit_blend_weights(out, mesh, poses);
  return out;
}

}  // namespace nook::bake
