// nook bake clips: the AO and the poses of a character's clips, for crowds without bones on the CPU.
#include <memory>

#include "bakers/job/clip_bake.h"
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
  std::filesystem::path input, model, output;
  bake::ImportOptions reading;
  bake::ClipTask task;
};

bake::BakedFile bake(const Options& o, const bake::ImportedCharacter& character) {
  const CharacterModel model =
      naming_file(o.model, [&] { return bake::model_of_character(read_file(o.model), character); });
  return naming_file(o.input, [&] {
    const bake::ClipFrames frames = bake::frames_of(character, o.task);
    platform::ProgressBar bar(o.common.quiet);
    return bake::bake_clips_file(character, model, frames, o.task,
                                 [&](bake::JobStage, std::size_t done, std::size_t total) {
                                   bar.show("ray tracing", "frames", done, total);
                                   return !interrupted();
                                 });
  });
}

void run(Options o) {
  o.task.tables.seed = o.common.seed;
  run_bake({o.common, o.output, {{{"the character", o.input}, {"the model", o.model}}, {}, {}}}, [&] {
    const bake::ImportedCharacter character = read_character(o.input, o.reading, o.common);
    require_clips(o.task.clips, character);
    // The table has one line for each row; the error by modes is for the report.
    return one_row(bake(o, character), {"error_of_modes"});
  });
}

}  // namespace

void add_bake_clips(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "clips",
      "the ray-traced AO and the poses of a character's clips as a small table over frames: a crowd that is "
      "drawn from baked animation needs no bones on the CPU");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_option("input", o.input, "the character, .glb or .gltf").required();
  command.add_option("model", o.model, "its baked model, .nook").required();
  command.add_option("-o,--output", o.output, "the .nook file to write").required();
  command.add_option("--clips", o.task.clips, "only these clips (default: all but T- and A-poses)")
      .delimiter(',');
  command.add_option("--frames-per-second", o.task.frames_per_second, "frames of each second of a clip")
      .check(in_range(0.1, 1000.0))
      .capture_default_str();
  command.add_option("--rays", o.task.rays, "rays for each vertex and frame")
      .check(in_range(1, 65536))
      .capture_default_str();
  command
      .add_option("--max-error", o.task.tables.max_error,
                  "AO, root mean square: the file takes as many modes as this needs")
      .check(in_range(1e-4, 1.0))
      .capture_default_str();
  command
      .add_option("--max-bytes", o.task.tables.max_bytes,
                  "bytes of the file for each frame and vertex; modes beyond it are left out")
      .check(in_range(1e-4, 100.0))
      .capture_default_str();
  command.add_option("--max-modes", o.task.tables.max_modes, "modes of AO, a multiple of 4")
      .check(in_range(4u, ClipSet::max_ao_modes))
      .capture_default_str();
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
