#include "bakers/measure/character/character_report.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "bakers/character/judgement.h"
#include "bakers/character/pose_sets.h"
#include "bakers/import/clip.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/surface_error.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

double ratio(double error, double baseline) {
  return baseline > 0 ? error / baseline : 0;
}

// Finds the clip with the largest error relative to the static bake's error over the same poses.
void add_worst_clip(Json& row, const EvaluatedPoses& measured, const CharacterEvaluation& e) {
  if (measured.clip.size() != e.pose_visible.size()) return;
  std::vector<PoseErrorSums> clips(measured.clips.size());
  PoseErrorSums body;
  for (std::size_t t = 0; t < e.pose_visible.size(); ++t)
    for (PoseErrorSums* sums : {&clips[measured.clip[t]], &body}) {
      sums->model += e.pose_visible[t].model;
      sums->static_bake += e.pose_visible[t].static_bake;
    }
  const auto share = [](const PoseErrorSums& s) { return ratio(s.model, s.static_bake); };
  const auto worst = std::max_element(clips.begin(), clips.end(),
                                      [&](const auto& a, const auto& b) { return share(a) < share(b); });
  row["worst_clip"] = measured.clips[std::size_t(worst - clips.begin())];
  row["worst_clip_ratio_to_static_visible"] = share(*worst);
  row["worst_clip_over_body"] = ratio(share(*worst), share(body));
}

Json model_row(const BakedCharacter& baked, const EvaluatedPoses& measured, const std::string& name,
               const CharacterEvaluation& e) {
  const CharacterModel& model = baked.model;
  Json row;
  row["character"] = name;
  row["protocol"] = measured.protocol;
  row["vertices"] = model.vertex_count();
  row["bones"] = baked.character.mesh.bones.size();
  row["spheres"] = model.spheres.size();
  row["key_points"] = model.key_points.size();
  row["model_bytes"] = baked.model_bytes.size();
  const Container file(baked.model_bytes, character_kind);
  row["map_bytes"] = file.section("FMAP").remaining();
  row["bind_bytes"] = file.has("BIND") ? file.section("BIND").remaining() : 0;
  row["rest_bytes"] = file.has("REST") ? file.section("REST").remaining() : 0;
  row["poses"] = e.poses;
  row["rays"] = e.rays;
  row["noise_floor_mse"] = e.noise_floor_mse;
  row["visible_share"] = e.visible_share;
  row["mse_visible"] = e.model.mse_visible;
  row["mse_static_visible"] = e.static_bake.mse_visible;
  row["mse_oracle_visible"] = e.oracle.mse_visible;
  row["ratio_to_static_visible"] = ratio(e.model.mse_visible, e.static_bake.mse_visible);
  row["ratio_to_static_visible_by_area"] = ratio(e.model.mse_visible_area, e.static_bake.mse_visible_area);
  row["mse"] = e.model.mse;
  row["rmse"] = std::sqrt(e.model.mse);
  row["mse_area"] = e.model.mse_area;
  row["mse_body"] = e.model.mse_body;
  row["mse_hands"] = e.model.mse_hands;
  row["mse_static"] = e.static_bake.mse;
  row["mse_area_static"] = e.static_bake.mse_area;
  row["mse_oracle"] = e.oracle.mse;
  row["mse_area_oracle"] = e.oracle.mse_area;
  row["ratio_to_static"] = ratio(e.model.mse, e.static_bake.mse);
  row["ratio_to_static_area"] = ratio(e.model.mse_area, e.static_bake.mse_area);
  row["ratio_to_oracle_visible"] = ratio(e.model.mse_visible, e.oracle.mse_visible);
  add_worst_clip(row, measured, e);
  return row;
}

// If the errors are close to the noise of the rays, measures them a second time without the noise. To do so,
// each squared error is computed as the product of the errors against two independent tracings.
void add_errors_without_noise(Json& row, const BakedCharacter& baked, std::span<const Pose> poses,
                              const CharacterReportSettings& settings, const CharacterEvaluation& e,
                              const StageProgress& progress) {
  constexpr double near_noise = 0.2;
  if (e.noise_floor_mse < near_noise * e.model.mse_visible) return;
  const SkinnedMesh& mesh = baked.character.mesh;
  const AoTargets second = trace_character_ao(
      mesh, poses, settings.rays, mix_bits(settings.seed ^ 0x7365636f6e64ull), progress("ray tracing again"));
  const VisibleErrors errors = visible_errors(mesh, baked.model, poses, e.truth, second);
  row["mse_visible_without_noise"] = errors.by_vertices.model;
  row["mse_static_visible_without_noise"] = errors.by_vertices.static_bake;
  row["mse_oracle_visible_without_noise"] = errors.oracle;
  row["ratio_to_static_visible_without_noise"] = errors.by_vertices.over_static();
  row["ratio_to_static_visible_by_area_without_noise"] = errors.by_area.over_static();
  row["ratio_to_oracle_visible_without_noise"] = ratio(errors.by_vertices.model, errors.oracle);
}

// Adds the errors at points between vertices.
void add_surface_errors(Json& row, const BakedCharacter& baked, std::span<const Pose> poses,
                        std::uint64_t seed, const StageProgress& progress) {
  const SurfaceErrors errors = measure_surface(baked.character.mesh, baked.model, poses, seed,
                                               progress("ray tracing between the vertices"));
  row["mse_surface"] = errors.model;
  row["mse_surface_static"] = errors.static_bake;
  row["mse_surface_exact_vertices"] = errors.exact_vertices;
  row["ratio_to_static_surface"] = ratio(errors.model, errors.static_bake);
}

// Fits other methods to the training poses of the model, and measures them on the same targets as the model.
void add_peers(Json& row, const ImportedCharacter& character, const Recipe* recipe,
               std::span<const Pose> measured, const AoTargets& truth,
               const CharacterReportSettings& settings, const StageProgress& progress) {
  const std::vector<Pose> training = recipe ? recipe_poses(character, *recipe) : std::vector<Pose>();
  if (training.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "other methods are fitted to the model's training poses, but the model does not store the "
                  "recipe that is needed to make these poses again; bake the model again");
  const SkinnedMesh& mesh = character.mesh;
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const AoTargets fitted = trace_character_ao(mesh, training, recipe->settings.rays, recipe->settings.seed,
                                              progress("ray tracing the training poses"));
  for (const CharacterPeer& peer : settings.peers) {
    const auto regression = peer.fit(mesh, training, fitted, settings.seed);
    const RegressionError error = measure_regression(*regression, measured, truth, area);
    const std::string name = peer.name;
    row["mse_" + name] = error.mse;
    row["mse_" + name + "_visible"] = error.mse_visible;
    row["mse_area_" + name] = error.mse_area;
    row["bytes_" + name] = regression->model_bytes();
    row["tuned_" + name] = regression->description();
  }
}

// Adds the errors of the runtime's update, once with the default far_error of scenes and once with exact
// sums.
void add_update_errors(Json& row, const CharacterModel& model, std::span<const Pose> poses,
                       const AoTargets& truth) {
  const UpdateErrors by_default = measure_update(model, poses, truth, SceneSettings().far_error),
                     exact = measure_update(model, poses, truth, 0);
  row["mse_update"] = by_default.mse;
  row["mse_update_exact"] = exact.mse;
  row["mse_update_visible"] = by_default.mse_visible;
  row["mse_update_exact_visible"] = exact.mse_visible;
}

}  // namespace

std::uint64_t evaluation_ray_seed(std::uint64_t seed) {
  return mix_bits(seed ^ 0x6576616c75617465ull);
}

std::optional<Recipe> stored_recipe(const BakedCharacter& baked) {
  if (baked.model.recipe.empty()) return std::nullopt;
  return read_recipe(baked.character, std::string_view(baked.model.recipe));
}

CharacterReport measure_character(const BakedCharacter& baked, const Recipe* recipe,
                                  const EvaluatedPoses& measured, const CharacterReportSettings& settings,
                                  const StageProgress& progress) {
  CharacterReport report;
  report.evaluation = evaluate_character(baked.character.mesh, baked.model, measured.poses, settings.rays,
                                         evaluation_ray_seed(settings.seed), progress("ray tracing"));
  report.row = model_row(baked, measured, settings.name, report.evaluation);
  add_errors_without_noise(report.row, baked, measured.poses, settings, report.evaluation, progress);
  add_surface_errors(report.row, baked, measured.poses, mix_bits(settings.seed ^ 0x73757266616365ull),
                     progress);
  add_update_errors(report.row, baked.model, measured.poses, report.evaluation.truth);
  if (!settings.peers.empty())
    add_peers(report.row, baked.character, recipe, measured.poses, report.evaluation.truth, settings,
              progress);
  return report;
}

std::vector<Pose> caster_poses(const ImportedCharacter& character, std::size_t count) {
  const std::vector<std::size_t> clips = motion_clips(character);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    // `count` poses are spread evenly over all clips. This computes which of these poses belong to clip `i`.
    const std::size_t first = (i * count + clips.size() - 1) / clips.size(),
                      end = ((i + 1) * count + clips.size() - 1) / clips.size();
    const std::vector<Pose> own = clip_poses(character, {&clips[i], 1}, end - first);
    poses.insert(poses.end(), own.begin(), own.end());
  }
  if (poses.empty()) poses.push_back(rest_pose(character));
  return poses;
}

BodyPair contact_pair(const BakedCharacter& baked, const std::string& receiver_clip,
                      const std::string& caster_clip, Vec3 offset, float turn_degrees) {
  const auto middle_of = [&](const std::string& name) {
    const std::size_t clip = find_clip(baked.character, name);
    return sample_clip(baked.character, clip, baked.character.clips[clip].duration_s / 2);
  };
  return body_pair(baked.model, middle_of(receiver_clip), middle_of(caster_clip), offset,
                   turn_degrees * std::numbers::pi_v<float> / 180);
}

Json caster_rows(const std::vector<CasterRow>& rows) {
  Json array = Json::array();
  for (const CasterRow& r : rows)
    array.push_back({{"distance_m", r.distance_m},
                     {"distance_radii", r.distance_radii},
                     {"form", r.form},
                     {"darkening", r.darkening},
                     {"darkening_traced", r.darkening_traced},
                     {"ratio", r.darkening_traced > 0 ? r.darkening / r.darkening_traced : 0},
                     {"mse_over_none", r.mse_over_none},
                     {"rms_darkened", r.rms_darkened},
                     {"share_inside", r.share_inside},
                     {"change_of_groups", r.change_of_groups}});
  return array;
}

}  // namespace nook::measure
