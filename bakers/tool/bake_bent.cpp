// `nook bake bent` adds bent normals to a model that is already baked.
#include <memory>

#include "bakers/job/vertex_bakes.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/stored_meshes.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

struct Options {
  CommonOptions common;
  BakeOptions baking;
  std::filesystem::path model, input;
  bake::ImportOptions reading;
  bake::BentTask task;
};

bake::BakedFile bake(const Options& o, const bake::ImportedCharacter& character, const CharacterModel& model,
                     const bake::BakeIdentity& identity) {
  platform::ProgressBar bar(o.common.quiet);
  return bake::bake_bent_file(
      character, model, o.task,
      [&](bake::JobStage, std::size_t done, std::size_t total) {
        bar.show("ray tracing", "poses", done, total);
        return !interrupted();
      },
      identity);
}

PreparedBake prepare(const Options& o) {
  const std::vector<std::byte> bytes = read_file(o.model);
  bake::ImportedCharacter character =
      read_character(o.input, with_stored_meshes(o.reading, o.model, bytes, o.common), o.common);
  CharacterModel model = naming_file(o.model, [&] { return bake::model_of_character(bytes, character); });
  const bake::BakeIdentity identity = bake::identify_bent(character, bytes, o.task);
  return {identity, [&o, character = std::move(character), model = std::move(model), identity] {
            return one_row(naming_file(o.model, [&] { return bake(o, character, model, identity); }));
          }};
}

void run(Options o) {
  o.task.seed = o.common.seed;
  run_bake({o.common, o.baking, {{{"the character", o.input}, {"the model", o.model}}, {}, {}}},
           [&] { return prepare(o); });
}

}  // namespace

void add_bake_bent(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "bent",
      "add bent normals to the baked model of a character.\nA bent normal is the mean direction in which a "
      "point is open. The bake traces rays in a few poses of the body. For each vertex, it stores two "
      "vectors that describe which directions the body blocks. The AO of the model does not change.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("character", o.input, "the rigged character, a .glb or .gltf file").required();
  command.add_input("model", o.model, "the model that was baked from the character, a .nook file").required();
  add_bake_options(command, o.baking);
  command.add_option("--auto-poses", o.task.auto_poses, "number of generated poses in which to trace rays")
      .check(in_range(8, 100000))
      .capture_default_str();
  command
      .add_option("--samples-per-clip", o.task.samples_per_clip,
                  "number of poses in which to trace rays, for each clip that the model was fitted to")
      .check(in_range(1, 100000))
      .capture_default_str();
  command.add_option("--rays", o.task.rays, "number of rays per vertex and pose")
      .check(in_range(1, 65536))
      .capture_default_str();
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
