#include "bakers/job/clip_bake.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/import/content_hash.h"
#include "bakers/raytrace/stand_ins.h"
#include "platform/peak_memory.h"
#include "platform/stopwatch.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

// A NaN is outside every range. The lower bounds leave room for the rounding of 0.1f and 1e-4f.
void require_between(const char* name, double value, double low, double high) {
  if (!(value >= low * (1 - 1e-6) && value <= high))
    fail_range(NOOK_ERROR_INVALID_ARGUMENT, name, NumberText(value), NumberText(low), NumberText(high));
}

std::string clip_recipe(const ImportedCharacter& character, const ClipTask& task) {
  Json recipe;
  recipe["frames_per_second"] = task.frames_per_second;
  recipe["rays"] = task.rays;
  recipe["seed"] = task.tables.seed;
  recipe["max_error"] = task.tables.max_error;
  recipe["max_bytes"] = task.tables.max_bytes;
  recipe["content"] = content_digits(character);
  return recipe.dump();
}

}  // namespace

std::vector<std::size_t> chosen_clips(const ImportedCharacter& character,
                                      std::span<const std::string> names) {
  std::vector<std::size_t> clips;
  if (names.empty()) clips = motion_clips(character);
  for (const std::string& name : names) clips.push_back(find_clip(character, name));
  std::sort(clips.begin(), clips.end(),
            [&](std::size_t a, std::size_t b) { return character.clips[a].name < character.clips[b].name; });
  clips.erase(std::unique(clips.begin(), clips.end()), clips.end());
  if (clips.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the character has no clip that shows motion; name the clips to bake");
  return clips;
}

ClipTask clip_task_of(const nook_bake_clips_desc& desc) {
  ClipTask task;
  task.frames_per_second = double(desc.frames_per_second);
  task.rays = desc.rays;
  task.tables.seed = desc.seed;
  task.tables.max_error = double(desc.max_error);
  task.tables.max_bytes = double(desc.max_bytes);
  task.tables.max_modes = desc.max_modes;
  require_between("desc.rays", desc.rays, 1, 65536);
  require_between("desc.frames_per_second", task.frames_per_second, 0.1, 1000);
  require_between("desc.max_error", task.tables.max_error, 1e-4, 1);
  require_between("desc.max_bytes", task.tables.max_bytes, 1e-4, 100);
  require_between("desc.max_modes", desc.max_modes, 4, ClipSet::max_ao_modes);
  if (desc.max_modes % 4 != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.max_modes is not a multiple of 4 (got %u)",
                  desc.max_modes);
  if (desc.clip_count > 0) need(desc.clip_names, "desc.clip_names");
  for (std::uint32_t i = 0; i < desc.clip_count; ++i) {
    need(desc.clip_names[i], "desc.clip_names[i]");
    task.clips.emplace_back(desc.clip_names[i]);
  }
  return task;
}

ClipFrames frames_of(const ImportedCharacter& character, const ClipTask& task) {
  ClipFrames frames = clip_frames(character, chosen_clips(character, task.clips), task.frames_per_second);
  if (frames.poses.size() > ClipSet::max_frames)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the clips have too many frames (got %zu, need at most %u)",
                  frames.poses.size(), ClipSet::max_frames);
  return frames;
}

BakeIdentity identify_clips(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                            const ClipTask& task) {
  const ClipTableSettings& tables = task.tables;
  nlohmann::json names = nlohmann::json::array();
  for (const std::size_t clip : chosen_clips(character, task.clips))
    names.push_back(character.clips[clip].name);
  return identify_bake(BakeKind::clips,
                       {{"clips", names},
                        {"frames_per_second", task.frames_per_second},
                        {"rays", task.rays},
                        {"seed", tables.seed},
                        {"max_error", tables.max_error},
                        {"max_pose_error", tables.max_pose_error},
                        {"max_bytes", tables.max_bytes},
                        {"max_modes", tables.max_modes}},
                       {{"character", content_hash(character)}, {"model", sha256(model_bytes)}});
}

BakedFile bake_clips_file(const ImportedCharacter& character, const CharacterModel& model,
                          const ClipFrames& frames, const ClipTask& task, const StageReport& progress,
                          const BakeIdentity& identity) {
  const platform::Stopwatch watch;
  const Progress ray_progress = [&](std::size_t done, std::size_t total) {
    return progress(JobStage::raytrace, done, total);
  };
  const StandIns stand_ins = choose_stand_ins(character.mesh, frames.poses, task.tables.seed, ray_progress);
  const AoTargets targets =
      trace_character_ao(character.mesh, frames.poses, task.rays, task.tables.seed, ray_progress, stand_ins);
  const double seconds_raytrace = watch.seconds();
  const double noise =
      measure_noise_floor(character.mesh, frames.poses, targets, task.rays, task.tables.seed, stand_ins);
  ClipTableReport tables;
  ClipSet set = make_clip_set(character.mesh, model, frames, targets, noise, task.tables, tables);
  set.recipe = with_identity(clip_recipe(character, task), identity);
  BakedFile file;
  file.model = write_clip_set(set);
  Json report;
  report["clips"] = set.clips.size();
  report["frames"] = set.frame_count;
  report["vertices"] = set.ao.rows;
  report["rays"] = task.rays;
  report["modes"] = set.ao.modes;
  report["pose_modes"] = set.pose.modes;
  report["file_bytes"] = file.model.size();
  report["bytes_per_frame_vertex"] =
      double(file.model.size()) / (double(set.frame_count) * double(set.ao.rows));
  report["ao_bytes"] = set.ao.mode.size() + 2 * set.ao.weight.size() + 4 * set.ao.scale.size();
  report["pose_bytes"] = 2 * set.pose.mode.size() + 2 * set.pose.weight.size() + 4 * set.pose.scale.size() +
                         16 * set.bones.size();
  report["error"] = tables.error;
  report["pose_error_m"] = tables.pose_error;
  report["noise_floor_mse"] = noise;
  report["error_of_modes"] = tables.error_of_modes;
  report["seconds_raytrace"] = seconds_raytrace;
  report["seconds"] = watch.seconds();
  report["peak_bytes"] = platform::peak_bytes();
  file.report = report.dump(2, ' ', false, Json::error_handler_t::replace);
  return file;
}

}  // namespace nook::bake
