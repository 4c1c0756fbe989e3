#include "bakers/job/character_job.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bakers/character/export_model.h"
#include "bakers/character/judgement.h"
#include "bakers/character/offset_fit.h"
#include "bakers/character/pose_sets.h"
#include "bakers/import/content_hash.h"
#include "bakers/raytrace/worker_arena.h"
#include "bakers/world/fit_casters.h"
#include "platform/peak_memory.h"
#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// The limits are far above the values of any sensible bake. Without them, invalid input could allocate all
// memory.
constexpr std::uint32_t max_spheres = 1024, max_key_points = 4096, max_rays = 65536, max_poses = 1'000'000,
                        max_steps = 10'000'000;

[[noreturn]] void unknown(const char* name, int value) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "%s has an unknown value (got %d); use a constant of nook_bake.h", name, value);
}

Preset preset_of(nook_bake_preset preset) {
  switch (preset) {
    case NOOK_BAKE_PRESET_DRAFT:
      return Preset::draft;
    case NOOK_BAKE_PRESET_STANDARD:
      return Preset::standard;
    case NOOK_BAKE_PRESET_PRODUCTION:
      return Preset::production;
    default:
      unknown("desc.preset", preset);
  }
}

PoseMode mode_of(nook_bake_pose_mode mode) {
  switch (mode) {
    case NOOK_BAKE_POSES_AUTO:
      return PoseMode::automatic;
    case NOOK_BAKE_POSES_SINGLE_JOINT:
      return PoseMode::single_joint;
    case NOOK_BAKE_POSES_CLIPS:
      return PoseMode::clips;
    case NOOK_BAKE_POSES_ALL:
      return PoseMode::all;
    case NOOK_BAKE_POSES_EXTRA:
      return PoseMode::extra;
    default:
      unknown("desc.pose_mode", mode);
  }
}

bool is_paper(const char* name, nook_form form) {
  if (form != NOOK_FORM_DEFAULT && form != NOOK_FORM_PAPER) unknown(name, form);
  return form == NOOK_FORM_PAPER;
}

FitMethod fit_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study) {
  const bool whole = is_paper("desc.form", desc.form), part = is_paper("desc.next: fit", study.fit);
  return whole || part ? FitMethod::paper : FitMethod::nook;
}

KernelForm kernel_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study) {
  const bool whole = is_paper("desc.form", desc.form), part = is_paper("desc.next: kernel", study.kernel);
  return whole || part ? KernelForm::paper : KernelForm::nook;
}

std::vector<std::size_t> chosen_clips(const nook_bake_character_desc& desc, nook_bake_clip_split clip_split,
                                      const ImportedCharacter& character) {
  std::vector<std::size_t> clips;
  if (desc.clip_count > 0) {
    need(desc.clip_names, "desc.clip_names");
    for (std::uint32_t i = 0; i < desc.clip_count; ++i) {
      need(desc.clip_names[i], "desc.clip_names[i]");
      clips.push_back(find_clip(character, desc.clip_names[i]));
    }
    std::sort(clips.begin(), clips.end(), [&](std::size_t a, std::size_t b) {
      return character.clips[a].name < character.clips[b].name;
    });
    clips.erase(std::unique(clips.begin(), clips.end()), clips.end());
    return clips;
  }
  clips = motion_clips(character);
  if (clip_split == NOOK_BAKE_SPLIT_HALF) return split_clips(clips).fitted;
  if (clip_split == NOOK_BAKE_SPLIT_FAMILIES) {
    const ClipSplit split = split_families(character, clips);
    if (!clips.empty() && split.measured.empty())
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "desc.next: clip_split: the names of all %zu clips begin with the same word, so all clips belong "
          "to one family, and none would be left to measure; use the split by half, or name the clips to fit",
          clips.size());
    return split.fitted;
  }
  if (clip_split != NOOK_BAKE_SPLIT_ALL) unknown("desc.next: clip_split", clip_split);
  return clips;
}

// The time of an update is proportional to spheres times key points. The time of skinning is proportional to
// the vertices. Below about 1,000 vertices, both counts are limited in proportion to the vertices.
// docs/lab/character.md says by how much these limits increase the error.
void limit_capacity(const nook_bake_character_desc& desc, std::size_t vertices, BakeSettings& settings) {
  constexpr std::size_t least_key_points = 64, least_spheres = 48;
  if (!desc.key_points)
    settings.key_points = std::min(settings.key_points, std::max(vertices * 3 / 5, least_key_points));
  if (!desc.spheres)
    settings.spheres = std::min(settings.spheres, std::max(vertices * 2 / 15, least_spheres));
}

void choose_settings(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study,
                     std::size_t vertices, BakeSettings& settings) {
  check_at_most("desc.spheres", desc.spheres, max_spheres);
  check_at_most("desc.key_points", desc.key_points, max_key_points);
  check_at_most("desc.rays", desc.rays, max_rays);
  check_at_most("desc.steps", desc.steps, max_steps);
  need_threads(desc.threads);
  if (desc.spheres) settings.spheres = desc.spheres;
  if (desc.key_points) settings.key_points = desc.key_points;
  if (desc.rays) settings.rays = desc.rays;
  settings.kernel.form = kernel_of(desc, study);
  settings.fit = fit_of(desc, study);
  if (settings.fit == FitMethod::nook) limit_capacity(desc, vertices, settings);
  if (desc.steps) settings.steps = desc.steps;
  settings.seed = desc.seed;
  if (desc.saturation == NOOK_BAKE_UNSATURATED) {
    settings.saturation = 0;
  } else if (desc.saturation != 0) {
    if (!(desc.saturation > 0 && desc.saturation <= max_saturation))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.saturation is out of range (got %g, need 0 to %g, or NOOK_BAKE_UNSATURATED)",
                    double(desc.saturation), double(max_saturation));
    if (settings.fit != FitMethod::nook || (desc.gamma != 0 && desc.gamma != 1))
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "desc.saturation needs the default form and a gamma of 1 (got saturation %g, fit %s, gamma %g)",
          double(desc.saturation), name_of(settings.fit), double(desc.gamma));
    settings.saturation = desc.saturation;
  }
  settings.learn_gamma = desc.gamma == NOOK_BAKE_GAMMA_LEARNED;
  if (desc.gamma != 0 && !settings.learn_gamma) {
    check_fits("desc.gamma", desc.gamma, desc.gamma >= 1 && desc.gamma <= 8,
               "1 to 8, NOOK_BAKE_GAMMA_LEARNED, or 0 for the default");
    settings.kernel.gamma = desc.gamma;
  } else if (!settings.learn_gamma && desc.form == NOOK_FORM_PAPER) {
    settings.kernel.gamma = 2;
  }
  check_fits("desc.time_limit_s", desc.time_limit_s, desc.time_limit_s >= 0, "seconds, or 0 for none");
  settings.time_limit_s = desc.time_limit_s;
}

}  // namespace

Recipe recipe_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study,
                 const ImportedCharacter& character) {
  Recipe recipe;
  check_at_most("desc.next: calibration_pose_count", study.calibration_pose_count, max_poses);
  if (study.calibration_pose_count) need(study.calibration_poses_3x4, "desc.next: calibration_poses_3x4");
  recipe.preset = preset_of(desc.preset);
  const PresetValues preset = preset_values(recipe.preset, fit_of(desc, study));
  recipe.settings = preset.settings;
  choose_settings(desc, study, character.mesh.vertex_count(), recipe.settings);
  recipe.poses = mode_of(desc.pose_mode);
  recipe.content = content_digits(character);
  recipe.extra_poses = desc.extra_pose_count;
  if (desc.extra_pose_count) need(desc.extra_poses_3x4, "desc.extra_poses_3x4");
  check_at_most("desc.auto_pose_count", desc.auto_pose_count, max_poses);
  check_at_most("desc.samples_per_clip", desc.samples_per_clip, max_poses);
  check_at_most("desc.extra_pose_count", desc.extra_pose_count, max_poses);

  const bool clips = recipe.poses == PoseMode::clips || recipe.poses == PoseMode::all;
  if (!clips && desc.clip_count > 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.clip_names are given but desc.pose_mode uses no clips; use NOOK_BAKE_POSES_CLIPS or "
                  "NOOK_BAKE_POSES_ALL");
  if (clips) recipe.clips = chosen_clips(desc, study.clip_split, character);
  if (recipe.poses == PoseMode::clips && recipe.clips.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.pose_mode is NOOK_BAKE_POSES_CLIPS but the character has no clip that "
                  "shows motion; use NOOK_BAKE_POSES_AUTO");
  if (!recipe.clips.empty())
    recipe.samples_per_clip =
        desc.samples_per_clip ? desc.samples_per_clip : samples_per_clip(preset, recipe.clips.size());
  if (recipe.poses == PoseMode::automatic || recipe.poses == PoseMode::all)
    recipe.auto_poses = desc.auto_pose_count ? desc.auto_pose_count : preset.auto_poses;
  if (recipe.poses == PoseMode::all) {
    recipe.variant_poses = recipe.clips.size() * recipe.samples_per_clip;
    // Variant poses replace automatic poses instead of being added, so that a bake does not take longer.
    if (!desc.auto_pose_count) recipe.auto_poses -= std::min(recipe.variant_poses, recipe.auto_poses / 2);
  }
  if (recipe.poses == PoseMode::single_joint) recipe.single_joint_steps = preset.single_joint_steps;
  if (recipe.poses == PoseMode::extra && desc.extra_pose_count == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.pose_mode is NOOK_BAKE_POSES_EXTRA but desc.extra_pose_count is 0; give "
                  "poses");
  return recipe;
}

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

// Returns the error figures by which a build pipeline can decide to reject a model.
Json figures_of(const Judgement& judgement) {
  return {
      {"on", text_of(judgement.source)},
      {"poses", judgement.poses},
      {"over_static", judgement.over_static()},
      {"over_static_by_area", judgement.errors.by_area.over_static()},
      {"over_oracle", judgement.over_oracle()},
      {"worst_clip_over_static", judgement.clips.empty() ? 0 : judgement.clips.front().error.over_static()}};
}

// Returns the body parts with the largest errors.
Json parts_of(std::span<const JudgedPart> parts) {
  constexpr std::size_t most = 8;
  Json rows = Json::array();
  for (const JudgedPart& part : parts.first(std::min(most, parts.size())))
    rows.push_back({{"name", part.name},
                    {"over_static", part.error.over_static()},
                    {"mse", part.error.model},
                    {"share_of_error", part.share_of_error},
                    {"share_of_area", part.share_of_area}});
  return rows;
}

Json judgement_of(const Judgement& judgement) {
  Json j = figures_of(judgement);
  j["poor"] = judgement.is_poor();
  j["rays"] = judgement.rays;
  j["mse"] = judgement.errors.by_vertices.model;
  j["mse_static"] = judgement.errors.by_vertices.static_bake;
  j["mse_oracle"] = judgement.errors.oracle;
  j["torn_edges"] = judgement.torn_edges;
  j["bones_without_role"] = judgement.bones_without_role;
  j["parts"] = parts_of(judgement.parts);
  j["meshes"] = parts_of(judgement.meshes);
  j["clips"] = parts_of(judgement.clips);
  return j;
}

std::string dumped(const Json& j, int indent) {
  // Names come from files and may not be UTF-8.
  return j.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Returns the text of a recipe with the figures of the model added. `nook inspect` shows them as judged_*.
std::string with_figures(std::string_view recipe, const Judgement& judgement) {
  Json j = Json::parse(recipe);
  j["judged"] = figures_of(judgement);
  return dumped(j, -1);
}

std::string report_text(const ImportedCharacter& character, const Recipe& recipe, const CharacterModel& model,
                        std::size_t model_bytes, const BakeReport& report, const WorldCasterReport& casters,
                        const Judgement& judgement) {
  Json j;
  j["summary"] = summary_of(judgement);
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
  j["judged"] = judgement_of(judgement);
  return dumped(j, 2);
}

// With the draft preset, fitting the casters takes a few seconds. With the other presets, it takes a larger
// part of the bake's time.
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

namespace {

Progress tracing(const StageReport& progress) {
  return
      [&progress](std::size_t done, std::size_t total) { return progress(JobStage::raytrace, done, total); };
}

// Every fourth recorded pose is left out of the fit and used to judge the model. If there are fewer than 16
// recorded poses, all are fitted.
struct SplitRecording {
  std::vector<Pose> fitted, judged;
};
SplitRecording split_recording(std::span<const Pose> poses) {
  constexpr std::size_t every = 4, least = 16;
  SplitRecording split;
  for (std::size_t i = 0; i < poses.size(); ++i)
    (poses.size() >= least && i % every == every - 1 ? split.judged : split.fitted).push_back(poses[i]);
  return split;
}

JudgedPoses poses_to_judge(const ImportedCharacter& character, const Recipe& recipe,
                           SplitRecording recording) {
  constexpr std::size_t most = 120;
  if (recording.judged.empty()) return judged_poses(character, recipe);
  thin_out(recording.judged, most);
  return {JudgedPoses::Source::recorded, std::move(recording.judged), {}, {}};
}

// Returns the poses that the game most likely uses. These are the recorded poses. If there are none, they are
// poses picked at even intervals from the clips. If the bake has only generated poses, it is the rest pose.
// If only a few of the file's clips are fitted, the game also shows other motion, so automatic poses are
// added. Returns an empty list if the host passed poses, and for comparisons with the paper.
std::vector<Pose> likely_poses(const ImportedCharacter& character, const Recipe& recipe,
                               const CalibrationPoses& calibration) {
  constexpr std::size_t most_of_clips = 240, least_of_clips = 16;
  // If at least enough_clips clips are fitted, they also represent the other clips. With fewer clips,
  // automatic_for_each automatic poses are added for each clip pose. docs/lab/character.md has the
  // measurements behind both constants.
  constexpr std::size_t enough_clips = 4, automatic_for_each = 3;
  if (!calibration.poses.empty()) return split_recording(calibration.poses).fitted;
  if (recipe.settings.fit != FitMethod::nook || recipe.auto_poses == 0 || recipe.extra_poses > 0) return {};
  if (recipe.clips.empty()) return std::vector<Pose>(rest_pose_weight, Pose(character.mesh.bones.size()));
  std::vector<Pose> poses = clip_poses(character, recipe.clips, recipe.samples_per_clip);
  if (poses.size() < least_of_clips) return {};
  if (recipe.clips.size() >= enough_clips || recipe.clips.size() >= motion_clips(character).size()) {
    thin_out(poses, most_of_clips);
    return poses;
  }
  thin_out(poses, most_of_clips / (1 + automatic_for_each));
  std::vector<Pose> others = automatic_poses(character, recipe, automatic_for_each * poses.size(),
                                             mix_bits(recipe.settings.seed ^ 0x6c696b656c79ull));
  poses.insert(poses.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  return poses;
}

// Fits biases and scales to the poses that the game most likely uses. If there are few poses, the fit uses
// more rays per pose, because the noise of few poses does not average out.
void fit_to_use(CharacterModel& model, const ImportedCharacter& character, const Recipe& recipe,
                const CalibrationPoses& calibration, const StageReport& progress) {
  constexpr std::size_t all_rays = 7680, least_rays = 32, most_rays = 256;
  const std::vector<Pose> poses = likely_poses(character, recipe, calibration);
  if (poses.empty()) return;
  const auto rays = std::uint32_t(std::clamp(all_rays / poses.size(), least_rays, most_rays));
  calibrate_offsets(model, character.mesh, poses, {rays, mix_bits(recipe.settings.seed ^ 0x6f6666736574ull)},
                    tracing(progress));
}

// Returns a hash of the poses' matrices, or an empty text if there are no poses.
std::string hash_of_poses(std::span<const Pose> poses) {
  if (poses.empty()) return "";
  ContentHash hash;
  for (const Pose& pose : poses) hash.add_list(pose);
  return hash.hex();
}

}  // namespace

BakeIdentity identify_character(const ImportedCharacter& character, const Recipe& recipe,
                                std::span<const Pose> extra_poses, const CalibrationPoses& calibration) {
  nlohmann::json settings = nlohmann::json::parse(recipe_text(character, recipe));
  settings.erase("nook");     // the identity already contains both versions
  settings.erase("content");  // the identity of every bake already contains it
  // The text of a rig file can be long, so only its hash is stored.
  if (settings.contains("rig")) settings["rig"] = sha256(settings["rig"].dump());
  const WorldCasterSettings casters = caster_settings(recipe);
  settings["casters"] = {{"casters", casters.casters},
                         {"poses", casters.poses},
                         {"floor_points", casters.floor_points},
                         {"wall_points", casters.wall_points},
                         {"contact_points", casters.contact_points},
                         {"neighbour_points", casters.neighbour_points},
                         {"cone_points", casters.cone_points},
                         {"outline_points", casters.outline_points},
                         {"rays", casters.rays},
                         {"steps", casters.steps},
                         {"pull", casters.pull},
                         {"deviation_m", casters.deviation_m},
                         {"deviation_radius", casters.deviation_radius},
                         {"seed", casters.seed}};
  nlohmann::json inputs = {{"character", content_hash(character)}};
  if (!extra_poses.empty()) inputs["extra_poses"] = hash_of_poses(extra_poses);
  if (!calibration.poses.empty()) inputs["calibration_poses"] = hash_of_poses(calibration.poses);
  return identify_bake(BakeKind::character, settings, inputs);
}

BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const StageReport& progress,
                         const CalibrationPoses& calibration) {
  std::vector<Pose> poses = recipe_poses(character, recipe);
  poses.insert(poses.end(), extra_poses.begin(), extra_poses.end());
  BakeResult baked = bake_character(character.mesh, poses, recipe.settings,
                                    [&](BakeStage stage, std::size_t done, std::size_t total) {
                                      return progress(stage_of(stage), done, total);
                                    });
  fit_to_use(baked.model, character, recipe, calibration, progress);
  WorldCasterReport caster_report;
  // An object with one bone only moves and does not deform. Its casters are fitted in several rotations of
  // the object in front of walls and lights.
  const std::vector<Pose> caster_poses =
      character.mesh.bones.size() == 1 ? turned_poses(caster_settings(recipe).poses, 0) : std::move(poses);
  const std::vector<WorldCaster> casters = fit_world_casters(
      character.mesh, caster_poses, caster_settings(recipe), &caster_report,
      [&](std::size_t done, std::size_t total) { return progress(JobStage::casters, done, total); });
  baked.model.world_casters.assign(casters.begin(), casters.end());
  baked.model.bind = bind_data_of(character);
  baked.model.rest = rest_surface_of(character.mesh);
  const Judgement judgement =
      judge_model(character, quantise(baked.model), recipe,
                  poses_to_judge(character, recipe, split_recording(calibration.poses)),
                  mix_bits(recipe.settings.seed ^ 0x6a75646765ull), tracing(progress));
  baked.model.recipe = with_identity(with_figures(recipe_text(character, recipe), judgement),
                                     identify_character(character, recipe, extra_poses, calibration));
  BakedFile file;
  file.model = write_character_model(baked.model);
  file.report =
      report_text(character, recipe, baked.model, file.model.size(), baked.report, caster_report, judgement);
  return file;
}

BakeIdentity identify_calibration(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                                  const CalibrationPoses& calibration, const CalibrationTask& task) {
  return identify_bake(BakeKind::calibration, {{"rays", task.rays}, {"seed", task.seed}},
                       {{"character", content_hash(character)},
                        {"model", sha256(model_bytes)},
                        {"calibration_poses", hash_of_poses(calibration.poses)}});
}

BakedFile calibrate_file(const ImportedCharacter& character, CharacterModel model,
                         const CalibrationPoses& calibration, const CalibrationTask& task,
                         const StageReport& progress, const BakeIdentity& identity) {
  const Recipe recipe =
      model.recipe.empty() ? Recipe() : read_recipe(character, std::string_view(model.recipe));
  const SplitRecording recording = split_recording(calibration.poses);
  const double moved =
      calibrate_offsets(model, character.mesh, recording.fitted, {task.rays, task.seed}, tracing(progress));
  const Judgement judgement =
      judge_model(character, quantise(model), recipe, poses_to_judge(character, recipe, recording),
                  mix_bits(task.seed ^ 0x6a75646765ull), tracing(progress));
  model.recipe = with_identity(
      with_figures(model.recipe.empty() ? std::string_view("{}") : std::string_view(model.recipe), judgement),
      identity);
  BakedFile file;
  file.model = write_character_model(model);
  Json report;
  report["summary"] = summary_of(judgement);
  report["poses"] = calibration.poses.size();
  report["rays"] = task.rays;
  report["offset_rms"] = moved;
  report["model_bytes"] = file.model.size();
  report["judged"] = judgement_of(judgement);
  file.report = dumped(report, 2);
  return file;
}

}  // namespace nook::bake
