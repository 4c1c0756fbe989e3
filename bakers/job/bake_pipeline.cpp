#include "bakers/job/bake_pipeline.h"

#include <nlohmann/json.hpp>

#include "bakers/character/export_model.h"
#include "bakers/character/pose_sets.h"
#include "bakers/world/fit_casters.h"
#include "platform/peak_memory.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

JobStage stage_of(BakeStage stage) {
  switch (stage) {
    case BakeStage::raytrace:
      return JobStage::raytrace;
    case BakeStage::initialise:
      return JobStage::initialise;
    case BakeStage::fit:
      return JobStage::fit;
    case BakeStage::casters:
      break;
  }
  return JobStage::casters;
}

std::string report_text(const ImportedCharacter& character, const Recipe& recipe, const CharacterModel& model,
                        std::size_t model_bytes, const BakeReport& report, const WorldCasterReport& casters) {
  Json j;
  j["vertices"] = model.vertex_count();
  j["file_vertices"] = model.file_to_welded.size();
  j["bones"] = model.bone_count();
  j["spheres"] = model.spheres.size();
  j["key_points"] = model.key_points.size();
  j["gamma"] = model.kernel.gamma;
  j["model_bytes"] = model_bytes;
  j["seconds_raytrace"] = report.seconds_raytrace;
  j["seconds_fit"] = report.seconds_fit;
  j["seconds_world_casters"] = casters.seconds;
  j["world_casters"] = model.world_casters.size();
  j["world_caster_error_initial"] = casters.error_initial;
  j["world_caster_error"] = casters.error_fitted;
  j["iterations"] = report.iterations;
  j["train_poses"] = report.train_poses;
  j["rays"] = recipe.settings.rays;
  j["noise_floor_mse"] = report.noise_floor_mse;
  j["noise_floor_held_out_mse"] = report.noise_floor_held_out_mse;
  j["mse_initial"] = report.mse_initial;
  j["mse_train"] = report.mse_train;
  j["mse_held_out"] = report.mse_held_out;
  j["mse_held_out_file"] = report.mse_held_out_file;
  j["peak_bytes"] = platform::peak_bytes();
  Json names = Json::array();
  for (std::size_t clip : recipe.clips) names.push_back(character.clips[clip].name);
  j["clips"] = std::move(names);
  j["warnings"] = character.warnings;
  j["recipe"] = Json::parse(recipe_text(character, recipe));
  Json curve = Json::array();
  for (const CurvePoint& p : report.curve)
    curve.push_back({{"seconds", p.seconds}, {"mse_train", p.mse_train}, {"mse_held_out", p.mse_held_out}});
  j["curve"] = std::move(curve);
  // Names come from files and need not be UTF-8.
  return j.dump(2, ' ', false, Json::error_handler_t::replace);
}

// A draft takes a few seconds for the casters, the others a share of their time.
WorldCasterSettings caster_settings(const Recipe& recipe) {
  WorldCasterSettings settings;
  settings.seed = recipe.settings.seed;
  if (recipe.preset == Preset::draft) {
    settings.poses = 32;
    settings.steps = 8;
  } else if (recipe.preset == Preset::production) {
    settings.poses = 256;
    settings.steps = 30;
  }
  return settings;
}

}  // namespace

BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const StageReport& progress) {
  std::vector<Pose> poses = recipe_poses(character, recipe);
  poses.insert(poses.end(), extra_poses.begin(), extra_poses.end());
  BakeResult baked = bake_character(character.mesh, poses, recipe.settings,
                                    [&](BakeStage stage, std::size_t done, std::size_t total) {
                                      return progress(stage_of(stage), done, total);
                                    });
  WorldCasterReport caster_report;
  // An object of one bone has no poses but places: it is turned before walls and lights.
  const std::vector<Pose> caster_poses =
      character.mesh.bones.size() == 1 ? turned_poses(caster_settings(recipe).poses, 0) : std::move(poses);
  const std::vector<WorldCaster> casters = fit_world_casters(
      character.mesh, caster_poses, caster_settings(recipe), &caster_report,
      [&](std::size_t done, std::size_t total) { return progress(JobStage::casters, done, total); });
  baked.model.world_casters.assign(casters.begin(), casters.end());
  baked.model.bind = bind_data_of(character);
  baked.model.rest = rest_surface_of(character.mesh);
  baked.model.recipe = recipe_text(character, recipe);
  BakedFile file;
  file.model = write_character_model(baked.model);
  file.report = report_text(character, recipe, baked.model, file.model.size(), baked.report, caster_report);
  return file;
}

}  // namespace nook::bake
