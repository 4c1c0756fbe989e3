#include "bakers/job/lod_bake.h"

#include <nlohmann/json.hpp>

#include "bakers/character/export_model.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/character/vertex_fits.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

void require_same_bones(const CharacterModel& model, const SkinnedMesh& mesh) {
  if (model.bone_count() != mesh.bones.size())
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "the mesh has another skeleton than the model (got %zu bones, need %zu); export it with the "
        "skeleton of the full mesh",
        mesh.bones.size(), model.bone_count());
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    if (mesh.bones[b].name != std::string_view(model.bone_names[b]))
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "the mesh has another skeleton than the model (bone %zu: got %.60s, need %.60s); export it "
          "with the skeleton of the full mesh",
          b, mesh.bones[b].name.c_str(), model.bone_names[b].c_str());
}

std::vector<Pose> training_poses(const ImportedCharacter& lod, const LodTask& task) {
  Recipe recipe;
  recipe.poses = PoseMode::all;
  recipe.auto_poses = task.auto_poses;
  recipe.clips = motion_clips(lod);
  recipe.samples_per_clip = task.samples_per_clip;
  recipe.settings.seed = task.seed;
  return recipe_poses(lod, recipe);
}

}  // namespace

BakedFile bake_lod_file(const ImportedCharacter& lod, std::span<const std::byte> model_bytes,
                        const LodTask& task, const StageReport& progress) {
  const platform::Stopwatch watch;
  const CharacterModel full = read_character_model(model_bytes);
  require_same_bones(full, lod.mesh);
  const std::vector<Pose> poses = training_poses(lod, task);
  CharacterModel model = refit_vertices(
      full, lod.mesh, poses, {task.rays, task.seed},
      [&](std::size_t done, std::size_t total) { return progress(JobStage::raytrace, done, total); });
  model.bind = bind_data_of(lod);
  model.rest = rest_surface_of(lod.mesh);
  BakedFile file;
  file.model = write_character_model(model);
  Json report;
  report["vertices"] = model.vertex_count();
  report["vertices_full"] = full.vertex_count();
  report["file_vertices"] = model.file_to_welded.size();
  report["poses"] = poses.size();
  report["rays"] = task.rays;
  report["model_bytes"] = file.model.size();
  report["seconds"] = watch.seconds();
  file.report = report.dump(2, ' ', false, Json::error_handler_t::replace);
  return file;
}

}  // namespace nook::bake
