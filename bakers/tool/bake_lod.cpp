// `nook bake lod` makes the model for a mesh with less detail from the bake of the full mesh.
#include <memory>

#include "bakers/job/vertex_bakes.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

struct Options {
  CommonOptions common;
  BakeOptions baking;
  std::filesystem::path model, input;
  bake::ImportOptions reading;
  bake::LodTask task;
};

bake::BakedFile bake(const Options& o, const std::vector<std::byte>& model,
                     const bake::ImportedCharacter& lod) {
  platform::ProgressBar bar(o.common.quiet);
  return bake::bake_lod_file(lod, model, o.task, [&](bake::JobStage, std::size_t done, std::size_t total) {
    bar.show("ray tracing", "poses", done, total);
    return !interrupted();
  });
}

PreparedBake prepare(const Options& o) {
  std::vector<std::byte> model = read_file(o.model);
  bake::ImportedCharacter lod = read_character(o.input, o.reading, o.common);
  const bake::BakeIdentity identity = bake::identify_lod(lod, model, o.task);
  return {identity, [&o, model = std::move(model), lod = std::move(lod)] {
            return one_row(naming_file(o.model, [&] { return bake(o, model, lod); }));
          }};
}

void run(Options o) {
  o.task.seed = o.common.seed;
  run_bake({o.common, o.baking, {{{"the model", o.model}, {"the mesh", o.input}}, {}, {}}},
           [&] { return prepare(o); });
}

}  // namespace

void add_bake_lod(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "lod",
      "bake another mesh of a baked character, such as a simplified copy (level of detail).\nThe new model "
      "keeps the spheres, key points and casters of the character's model. The bake fits only the vertices "
      "of the new mesh, which takes seconds.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("model", o.model, "the model that was baked from the full mesh, a .nook file").required();
  command.add_input("mesh", o.input, "the other mesh, a .glb or .gltf file with the same skeleton")
      .required();
  add_bake_options(command, o.baking);
  command
      .add_option("--auto-poses", o.task.auto_poses,
                  "number of generated poses that the vertices are fitted to")
      .check(in_range(8, 100000))
      .capture_default_str();
  command
      .add_option("--samples-per-clip", o.task.samples_per_clip,
                  "number of poses to take from each clip in the file of the mesh; the vertices are fitted "
                  "to them too")
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
