#include "bakers/job/vertex_bakes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/character/export_model.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/character/vertex_fits.h"
#include "bakers/import/content_hash.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

void require_same_character(const CharacterModel& model, const SkinnedMesh& mesh) {
  bool is_same = model.bone_count() == mesh.bones.size() && model.vertex_count() == mesh.vertex_count() &&
                 std::equal(model.file_to_welded.begin(), model.file_to_welded.end(),
                            mesh.file_to_welded.begin(), mesh.file_to_welded.end());
  for (std::size_t b = 0; is_same && b < mesh.bones.size(); ++b)
    is_same = mesh.bones[b].name == std::string_view(model.bone_names[b]);
  if (!is_same)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the model was not baked from this character (the model has %zu vertices and %zu bones; "
                  "the character has %zu and %zu, or another order or other names of them); bake the "
                  "character first, or choose the same meshes as in its bake (--mesh, --without)",
                  model.vertex_count(), model.bone_count(), mesh.vertex_count(), mesh.bones.size());
}

}  // namespace

CharacterModel model_of_character(std::span<const std::byte> bytes, const ImportedCharacter& character) {
  CharacterModel model = read_character_model(bytes);
  require_same_character(model, character.mesh);
  return model;
}

namespace {

using Json = nlohmann::ordered_json;

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
  check_range("desc.rays", desc.rays, 1, 65536);
  check_range("desc.auto_pose_count", desc.auto_pose_count, 8, 100'000);
  check_range("desc.samples_per_clip", desc.samples_per_clip, 1, 100'000);
  return {desc.auto_pose_count, desc.samples_per_clip, desc.rays, desc.seed};
}

BakeIdentity identify_bent(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                           const BentTask& task) {
  return identify_bake(BakeKind::bent,
                       {{"auto_poses", task.auto_poses},
                        {"samples_per_clip", task.samples_per_clip},
                        {"rays", task.rays},
                        {"seed", task.seed},
                        {"pose_generation", pose_generation}},
                       {{"character", content_hash(character)}, {"model", sha256(model_bytes)}});
}

BakedFile bake_bent_file(const ImportedCharacter& character, CharacterModel model, const BentTask& task,
                         const StageReport& progress, const BakeIdentity& identity) {
  const platform::Stopwatch watch;
  const std::vector<Pose> poses = poses_of(character, model, task);
  const std::vector<OccludedEnds> ends = fit_occluded(
      character.mesh, poses, {task.rays, task.seed},
      [&](std::size_t done, std::size_t total) { return progress(JobStage::raytrace, done, total); });
  model.occluded.assign(ends.begin(), ends.end());
  model.recipe = with_identity(model.recipe, identity);
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

namespace {

using Json = nlohmann::ordered_json;

void require_same_bones(const CharacterModel& model, const SkinnedMesh& mesh) {
  if (model.bone_count() != mesh.bones.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the skeleton of the mesh differs from the skeleton of the model (got %zu bones, need "
                  "%zu); export the mesh with the skeleton of the full mesh",
                  mesh.bones.size(), model.bone_count());
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    if (mesh.bones[b].name != std::string_view(model.bone_names[b]))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the skeleton of the mesh differs from the skeleton of the model (bone %zu: got %.60s, "
                    "need %.60s); export the mesh with the skeleton of the full mesh",
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

BakeIdentity identify_lod(const ImportedCharacter& lod, std::span<const std::byte> model_bytes,
                          const LodTask& task) {
  return identify_bake(BakeKind::lod,
                       {{"auto_poses", task.auto_poses},
                        {"samples_per_clip", task.samples_per_clip},
                        {"rays", task.rays},
                        {"seed", task.seed},
                        {"pose_generation", pose_generation}},
                       {{"character", content_hash(lod)}, {"model", sha256(model_bytes)}});
}

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
  model.recipe = with_identity(model.recipe, identify_lod(lod, model_bytes, task));
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
