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

// Makes the output. The table does not contain the keys that are only useful in the report file.
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
    throw ToolError(
        exit_bad_arguments,
        "--model needs --calibrate POSES, a file of recorded poses that its constants are fitted to");
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
             "method of the bake: default (Nook's own), or paper, which is the method of Le et al. 2019: "
             "--kernel paper, --fit paper and --gamma 2");
  add_choice(command, "--kernel", o.kernel, {{"nook", NOOK_FORM_DEFAULT}, {"paper", NOOK_FORM_PAPER}},
             "for comparisons: how the shadow of a sphere is computed. paper uses the kernel of Le et al. "
             "2019 with Nook's fit. Default: nook");
  add_choice(command, "--fit", o.fit, {{"nook", NOOK_FORM_DEFAULT}, {"paper", NOOK_FORM_PAPER}},
             "for comparisons: how the model is fitted. paper uses the fit of Le et al. 2019 (block "
             "coordinate descent with L-BFGS) with Nook's kernel. Default: nook");
  command
      .add_option_function(
          "--gamma", [&o](const std::string& text) { o.gamma = gamma_of(text); },
          "exponent of the norm that sums the shadows of the spheres, 1 to 8. learned tries several "
          "exponents in short fits and keeps the best. Default: 1, or 2 with --form paper")
      .type_name("G|learned")
      .check(in_range(1.0, 8.0) | one_of({"learned"}));
  command
      .add_option("--saturation", o.saturation,
                  "initial saturation of each key point, which limits the darkness where many spheres "
                  "overlap; the fit then adjusts it. 0 turns saturation off. Default: 0.5, or 0 with --form "
                  "paper, --fit paper or a --gamma other than 1")
      .check(in_range(0.0, 64.0));
}

}  // namespace

void add_bake_character(Command bake) {
  const Command command = bake.add_subcommand(
      "character", "bake the ambient occlusion (AO) model of a rigged character, for any pose");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("input", o.input, "the rigged character, a .glb or .gltf file").required();
  add_bake_options(command, o.baking);
  add_import_options(command, o.reading);
  add_choice(command, "--preset", o.preset,
             {{"draft", NOOK_BAKE_PRESET_DRAFT},
              {"standard", NOOK_BAKE_PRESET_STANDARD},
              {"production", NOOK_BAKE_PRESET_PRODUCTION}},
             "time and quality of the bake: draft (about a minute), standard (default, up to 5 minutes) or "
             "production (up to half an hour)");
  add_choice(
      command, "--poses", o.poses,
      {{"auto", NOOK_BAKE_POSES_AUTO},
       {"single-joint", NOOK_BAKE_POSES_SINGLE_JOINT},
       {"clips", NOOK_BAKE_POSES_CLIPS},
       {"all", NOOK_BAKE_POSES_ALL}},
      "poses that the model is fitted to: auto (generated poses), clips (poses of the file's clips), all "
      "(default: both), or single-joint (poses in which one joint at a time turns, on a grid of rotations)");
  command
      .add_option("--clips", o.clips,
                  "fit only these clips of the file; separate their names by commas. Default: see --split")
      .delimiter(',');
  add_choice(
      command, "--split", o.split,
      {{"all", NOOK_BAKE_SPLIT_ALL}, {"half", NOOK_BAKE_SPLIT_HALF}, {"families", NOOK_BAKE_SPLIT_FAMILIES}},
      "which clips to fit if you do not give --clips: all (default), half or families. half fits every "
      "second clip, in the byte order of the names, so that `nook evaluate character` can measure the "
      "others. families fits every second family of clips. The clips of a family have names that begin with "
      "the same word, such as Jump_Start and Jump_Land; a prefix that all names share does not count. "
      "T-poses and A-poses are never fitted");
  command.add_input(
      "--rig", o.rig,
      "read this rig file, which corrects the roles, limbs and parents that the bake detects for bones (see "
      "Rigs in docs/character.md). `nook inspect FILE --rig` shows what the bake detects");
  command
      .add_option("--spheres", o.spheres,
                  "largest number of proxy spheres, which ride on bones and cast the shadows. Default: 130, "
                  "or 100 with --preset production; fewer for meshes with less than about 1,000 vertices. "
                  "With --fit paper: always 130")
      .check(in_range(1, 1024));
  command
      .add_option("--key-points", o.key_points,
                  "largest number of key points, the places near the skin where shadows are summed. Default: "
                  "500, or 800 with --preset production; fewer for meshes with less than about 1,000 "
                  "vertices. With --fit paper: always 500")
      .check(in_range(1, 4096));
  command
      .add_option("--rays", o.rays,
                  "number of rays per vertex and pose. Default: 16, or 32 with --preset production, or 64 "
                  "with --model")
      .check(in_range(1, 65536));
  command
      .add_option("--auto-poses", o.auto_poses,
                  "number of generated poses. Default: 300 (--preset draft), 2700 (standard) or 10000 "
                  "(production). With --poses all, variants of clip poses replace up to half of them")
      .check(in_range(1, 1000000));
  command
      .add_option("--samples-per-clip", o.samples_per_clip,
                  "number of poses to take from each clip. By default, all clips together give about 200 "
                  "poses (--preset draft), 1100 (standard) or 4000 (production), but each clip at least 4 "
                  "and at most 64 (production: 256)")
      .check(in_range(1, 1000000));
  command
      .add_option("--steps", o.steps,
                  "number of optimisation steps of the fit. Default: 1500 (--preset draft), 20000 (standard) "
                  "or 60000 (production). With --fit paper, the number of rounds: 3, 20 or 100")
      .check(in_range(1, 10000000));
  add_form_options(command, o);
  command.add_input("--calibrate", o.calibration,
                    "file of poses that your game recorded with nook_scene_record_pose. As its last step, "
                    "the bake fits the constant and the scale of each vertex to these poses");
  command.add_input(
      "--model", o.model,
      "with --calibrate: do not bake a new model, but fit the constants and scales of this baked model of "
      "the character. Of the options for the fit, only --rays and --seed then have an effect");
  command
      .add_option("--time-limit", o.time_limit_s,
                  "stop the fit after this many seconds. Two bakes with this option can differ slightly. "
                  "Default: no limit")
      .check(positive_number());
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
