// `nook bake character` bakes the model of a rigged character, with the settings of nook_bake.h.
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/job/character_job.h"
#include "bakers/job/vertex_bakes.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/table.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"
#include "sdk/src/character/pose_record.h"

namespace nook::tool {
namespace {

struct Options {
  CommonOptions common;
  BakeOptions baking;
  std::filesystem::path input, calibration, model, rig;
  bake::ImportOptions reading;
  std::int32_t preset = NOOK_BAKE_PRESET_STANDARD, poses = NOOK_BAKE_POSES_ALL, split = NOOK_BAKE_SPLIT_ALL;
  std::int32_t form = NOOK_FORM_DEFAULT, kernel = NOOK_FORM_DEFAULT, fit = NOOK_FORM_DEFAULT;
  std::vector<std::string> clips;
  std::uint32_t spheres = 0, key_points = 0, rays = 0, steps = 0, auto_poses = 0, samples_per_clip = 0;
  float gamma = 0;
  std::optional<float> saturation;
  double time_limit_s = 0;
};

// The text of the option has already been checked. It is either a number in range or the word that is allowed
// instead.
float gamma_of(const std::string& text) {
  return text == "learned" ? NOOK_BAKE_GAMMA_LEARNED : std::strtof(text.c_str(), nullptr);
}

// Returns the settings as a descriptor. Its `character` is not set, because the command does not have a
// handle.
nook_bake_character_desc desc_of(const Options& options, const std::vector<const char*>& clips) {
  nook_bake_character_desc desc;
  nook_bake_character_desc_init(&desc);
  desc.form = options.form;
  desc.preset = options.preset;
  desc.spheres = options.spheres;
  desc.key_points = options.key_points;
  desc.rays = options.rays;
  desc.steps = options.steps;
  desc.pose_mode = options.poses;
  desc.auto_pose_count = options.auto_poses;
  desc.samples_per_clip = options.samples_per_clip;
  desc.clip_names = clips.data();
  desc.clip_count = std::uint32_t(clips.size());
  desc.seed = options.common.seed;
  desc.threads = options.common.threads;
  desc.gamma = options.gamma;
  if (options.saturation)
    desc.saturation = *options.saturation > 0 ? *options.saturation : NOOK_BAKE_UNSATURATED;
  desc.time_limit_s = options.time_limit_s;
  return desc;
}

bake::Recipe requested_recipe(const Options& options, const bake::ImportedCharacter& character) {
  nook_bake_character_study_desc study;
  nook_bake_character_study_desc_init(&study);
  study.clip_split = options.split;
  study.kernel = options.kernel;
  study.fit = options.fit;
  std::vector<const char*> clips;
  for (const std::string& name : options.clips) clips.push_back(name.c_str());
  return bake::recipe_of(desc_of(options, clips), study, character);
}

// Returns the poses of the file that --calibrate names, or nothing without this option. Poses of other bodies
// are left out.
bake::CalibrationPoses recorded_poses(const Options& options, const bake::SkinnedMesh& mesh) {
  if (options.calibration.empty()) return {};
  return naming_file(options.calibration, [&] {
    std::vector<std::string> names;
    for (const bake::Bone& bone : mesh.bones) names.push_back(bone.name);
    RecordedPoses recorded =
        read_pose_records(read_any_file(options.calibration), hash_of_bone_names(names), mesh.bones.size());
    if (recorded.poses.empty())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "none of its %zu poses belongs to this character (the number or the names of the bones "
                    "differ); record instances of a model that was baked from this file",
                    recorded.of_others);
    return bake::CalibrationPoses{std::move(recorded.poses)};
  });
}

// Leaves out of the table the keys that are only useful in the report file.
BakeOutput output_of(bake::BakedFile file) {
  nlohmann::ordered_json row = nlohmann::ordered_json::parse(file.report);
  const std::string summary = platform::printable(row["summary"].get<std::string>());
  for (const char* key : {"summary", "judged", "clips", "warnings", "recipe", "curve"}) row.erase(key);
  return {std::move(file.model), file.report + "\n",
          summary + "\n\n" + table_text(nlohmann::ordered_json::array({row}))};
}

bake::StageReport shown_on(platform::ProgressBar& bar) {
  return [&bar](bake::JobStage stage, std::size_t done, std::size_t total) {
    const bool traces = stage == bake::JobStage::raytrace;
    bar.show(bake::text_of(stage), traces ? "poses" : "steps", done, total);
    return !interrupted();
  };
}

PreparedBake prepare_calibration(const Options& options, bake::ImportedCharacter character,
                                 bake::CalibrationPoses calibration) {
  const std::vector<std::byte> bytes = read_file(options.model);
  CharacterModel model =
      naming_file(options.model, [&] { return bake::model_of_character(bytes, character); });
  bake::CalibrationTask task;
  if (options.rays) task.rays = options.rays;
  task.seed = options.common.seed;
  const bake::BakeIdentity identity = bake::identify_calibration(character, bytes, calibration, task);
  return {identity, [&options, character = std::move(character), calibration = std::move(calibration), task,
                     model = std::move(model), identity] {
            platform::ProgressBar bar(options.common.quiet);
            return output_of(naming_file(options.model, [&] {
              return bake::calibrate_file(character, model, calibration, task, shown_on(bar), identity);
            }));
          }};
}

PreparedBake prepare(const Options& options) {
  bake::ImportedCharacter character = read_character(options.input, options.reading, options.common);
  require_clips(options.clips, character);
  bake::CalibrationPoses calibration = recorded_poses(options, character.mesh);
  if (!options.model.empty())
    return prepare_calibration(options, std::move(character), std::move(calibration));
  bake::Recipe recipe = requested_recipe(options, character);
  recipe.meshes = options.reading.meshes;
  recipe.rig = read_rig_file(options.rig, character.mesh);
  const bake::BakeIdentity identity = bake::identify_character(character, recipe, {}, calibration);
  return {identity, [&options, character = std::move(character), recipe = std::move(recipe),
                     calibration = std::move(calibration)] {
            platform::ProgressBar bar(options.common.quiet);
            return output_of(bake::bake_by_recipe(character, recipe, {}, shown_on(bar), calibration));
          }};
}

void run(const Options& options) {
  if (!options.model.empty() && options.calibration.empty())
    throw ToolError(exit_bad_arguments, "--model needs --calibrate POSES, the poses to fit its constants to");
  const CommandFiles files{{{"the input", options.input},
                            {"--model", options.model},
                            {"--calibrate", options.calibration},
                            {"--rig", options.rig}},
                           {},
                           {}};
  BakeCommand command{options.common, options.baking, files};
  command.has_time_limit = options.time_limit_s > 0;
  run_bake(std::move(command), [&] { return prepare(options); });
}

using Names = std::map<std::string, std::int32_t>;

void add_choice(Command command, const char* name, std::int32_t& value, const Names& names,
                const char* help) {
  std::vector<std::string> keys;
  for (const auto& entry : names) keys.push_back(entry.first);
  command
      .add_option_function(
          name, [&value, names](const std::string& key) { value = names.at(key); }, help)
      .check(one_of(keys))
      .type_name("NAME");
}

// Adds the options for the form of the model and for the fit.
void add_form_options(Command command, Options& o) {
  add_choice(command, "--form", o.form, {{"default", NOOK_FORM_DEFAULT}, {"paper", NOOK_FORM_PAPER}},
             "method of the bake: default, or paper, which uses the kernel, the fit and the gamma of 2 of Le "
             "et al. 2019");
  add_choice(command, "--kernel", o.kernel, {{"nook", NOOK_FORM_DEFAULT}, {"paper", NOOK_FORM_PAPER}},
             "for comparisons: paper selects the kernel of the paper, and does not change the fit");
  add_choice(command, "--fit", o.fit, {{"nook", NOOK_FORM_DEFAULT}, {"paper", NOOK_FORM_PAPER}},
             "for comparisons: paper selects the fit of the paper (block coordinate descent with L-BFGS), "
             "and does not change the kernel");
  command
      .add_option_function(
          "--gamma", [&o](const std::string& text) { o.gamma = gamma_of(text); },
          "exponent of the shadow norm, 1 to 8, or learned, which tries several values in short fits and "
          "keeps the best; default 1, or 2 with --form paper")
      .type_name("G|learned")
      .check(in_range(1.0, 8.0) | one_of({"learned"}));
  command
      .add_option("--saturation", o.saturation,
                  "saturation of the key points at the start of the fit, which then adjusts it; 0 means no "
                  "saturation; default 0.5, or 0 with --form paper, --fit paper or a --gamma other than 1")
      .check(in_range(0.0, 64.0));
}

}  // namespace

void add_bake_character(Command bake) {
  const Command command =
      bake.add_subcommand("character", "bake a rigged character for dynamic ambient occlusion");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("input", o.input, "the rigged character, a .glb or .gltf file").required();
  add_bake_options(command, o.baking);
  add_import_options(command, o.reading);
  add_choice(command, "--preset", o.preset,
             {{"draft", NOOK_BAKE_PRESET_DRAFT},
              {"standard", NOOK_BAKE_PRESET_STANDARD},
              {"production", NOOK_BAKE_PRESET_PRODUCTION}},
             "time to spend: draft (a minute), standard (up to 5 minutes, default) or production (up to "
             "half an hour)");
  add_choice(command, "--poses", o.poses,
             {{"auto", NOOK_BAKE_POSES_AUTO},
              {"single-joint", NOOK_BAKE_POSES_SINGLE_JOINT},
              {"clips", NOOK_BAKE_POSES_CLIPS},
              {"all", NOOK_BAKE_POSES_ALL}},
             "poses to which the model is fitted: auto (generated poses), single-joint (each joint alone on "
             "a grid of rotations), clips (the file's clips), or all (auto and clips, default)");
  command.add_option("--clips", o.clips, "fit only these clips of the file, separated by commas")
      .delimiter(',');
  add_choice(
      command, "--split", o.split,
      {{"all", NOOK_BAKE_SPLIT_ALL}, {"half", NOOK_BAKE_SPLIT_HALF}, {"families", NOOK_BAKE_SPLIT_FAMILIES}},
      "which clips to fit when --clips is not given: all (default), half or families. half fits every second "
      "clip, in the byte order of the names, so that `evaluate` can measure the other clips. families is "
      "like half, but keeps clips together whose names begin with the same word, such as Jump_Start and "
      "Jump_Land; it ignores a prefix that all names share. T-poses and A-poses are never fitted");
  command.add_input(
      "--rig", o.rig,
      "rig file that corrects the roles, limbs and parents of bones (see Rigs in docs/character.md); `nook "
      "inspect FILE --rig` shows what the bake detects without this file");
  command.add_option("--spheres", o.spheres, "largest number of proxy spheres").check(in_range(1, 1024));
  command.add_option("--key-points", o.key_points, "largest number of key points").check(in_range(1, 4096));
  command.add_option("--rays", o.rays, "number of rays per vertex and pose").check(in_range(1, 65536));
  command.add_option("--auto-poses", o.auto_poses, "number of generated poses").check(in_range(1, 1000000));
  command.add_option("--samples-per-clip", o.samples_per_clip, "number of poses from each clip")
      .check(in_range(1, 1000000));
  command
      .add_option("--steps", o.steps,
                  "number of optimisation steps of the fit; with --fit paper, number of rounds")
      .check(in_range(1, 10000000));
  add_form_options(command, o);
  command.add_input("--calibrate", o.calibration,
                    "poses recorded from your game with nook_scene_record_pose; as the last step, the bake "
                    "fits the constant and the scale of each vertex to them");
  command.add_input("--model", o.model,
                    "with --calibrate: take this baked model of the character and fit only its constants and "
                    "scales; of the other options, only --rays and --seed have an effect");
  command
      .add_option("--time-limit", o.time_limit_s,
                  "end the fit after this many seconds; two bakes with this option can differ slightly")
      .check(positive_number());
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
