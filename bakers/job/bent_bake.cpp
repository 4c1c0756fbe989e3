#include "bakers/job/bent_bake.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/character/vertex_fits.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

void require_between(const char* name, std::uint32_t value, std::uint32_t low, std::uint32_t high) {
  if (value < low || value > high)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %u, need %u to %u)", name, value, low,
                  high);
}

std::vector<Pose> poses_of(const ImportedCharacter& character, const CharacterModel& model,
                           const BentTask& task) {
  Recipe recipe;
  recipe.poses = PoseMode::all;
  recipe.auto_poses = task.auto_poses;
  recipe.samples_per_clip = task.samples_per_clip;
  recipe.settings.seed = task.seed;
  recipe.clips = model.recipe.empty() ? motion_clips(character)
                                      : read_recipe(character, std::string_view(model.recipe)).clips;
  return recipe_poses(character, recipe);
}

}  // namespace

BentTask bent_task_of(const nook_bake_bent_desc& desc) {
  require_between("desc.rays", desc.rays, 1, 65536);
  require_between("desc.auto_pose_count", desc.auto_pose_count, 8, 100'000);
  require_between("desc.samples_per_clip", desc.samples_per_clip, 1, 100'000);
  return {desc.auto_pose_count, desc.samples_per_clip, desc.rays, desc.seed};
}

BakedFile bake_bent_file(const ImportedCharacter& character, CharacterModel model, const BentTask& task,
                         const StageReport& progress) {
  const platform::Stopwatch watch;
  const std::vector<Pose> poses = poses_of(character, model, task);
  const std::vector<OccludedEnds> ends = fit_occluded(
      character.mesh, poses, {task.rays, task.seed},
      [&](std::size_t done, std::size_t total) { return progress(JobStage::raytrace, done, total); });
  model.occluded.assign(ends.begin(), ends.end());
  BakedFile file;
  file.model = write_character_model(model);
  Json report;
  report["vertices"] = model.vertex_count();
  report["poses"] = poses.size();
  report["rays"] = task.rays;
  report["model_bytes"] = file.model.size();
  report["bent_bytes"] = Container(file.model, character_kind).section("BENT").remaining();
  report["seconds"] = watch.seconds();
  file.report = report.dump(2, ' ', false, Json::error_handler_t::replace);
  return file;
}

}  // namespace nook::bake
