#include "bakers/job/bent_bake.h"

#include <nlohmann/json.hpp>

#include "bakers/character/blocked_fit.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/measure/character/baked_character.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/model_file.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Pose> poses_of(const measure::BakedCharacter& baked, const BentTask& task) {
  Recipe recipe;
  recipe.poses = PoseMode::all;
  recipe.auto_poses = task.auto_poses;
  recipe.samples_per_clip = task.samples_per_clip;
  recipe.settings.seed = task.seed;
  recipe.clips = baked.model.recipe.empty()
                     ? motion_clips(baked.character)
                     : read_recipe(baked.character, std::string_view(baked.model.recipe)).clips;
  return recipe_poses(baked.character, recipe);
}

}  // namespace

BakedFile bake_bent_file(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                         const BentTask& task, const StageReport& progress) {
  const platform::Stopwatch watch;
  measure::BakedCharacter baked =
      measure::read_baked_character(character, {model_bytes.begin(), model_bytes.end()});
  const std::vector<Pose> poses = poses_of(baked, task);
  const std::vector<BlockedEnds> ends = fit_blocked(
      character.mesh, poses, {task.rays, task.seed},
      [&](std::size_t done, std::size_t total) { return progress(NOOK_BAKE_STAGE_RAYTRACE, done, total); });
  baked.model.blocked.assign(ends.begin(), ends.end());
  BakedFile file;
  file.model = write_character_model(baked.model);
  Json report;
  report["vertices"] = baked.model.vertex_count();
  report["poses"] = poses.size();
  report["rays"] = task.rays;
  report["model_bytes"] = file.model.size();
  report["bent_bytes"] = file.model.size() - model_bytes.size();
  report["seconds"] = watch.seconds();
  file.report = report.dump(2, ' ', false, Json::error_handler_t::replace);
  return file;
}

}  // namespace nook::bake
