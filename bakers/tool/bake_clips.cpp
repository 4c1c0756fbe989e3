// `nook bake clips` bakes the AO and the poses of a character's clips, for crowds without bones on the CPU.
#include <memory>

#include "bakers/job/clip_bake.h"
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
  std::filesystem::path input, model;
  bake::ImportOptions reading;
  bake::ClipTask task;
};

struct Inputs {
  bake::ImportedCharacter character;
  CharacterModel model;
  bake::ClipFrames frames;
  bake::BakeIdentity identity;
};

bake::BakedFile bake(const Options& o, const Inputs& in) {
  platform::ProgressBar bar(o.common.quiet);
  return bake::bake_clips_file(
      in.character, in.model, in.frames, o.task,
      [&](bake::JobStage, std::size_t done, std::size_t total) {
        bar.show("ray tracing", "frames", done, total);
        return !interrupted();
      },
      in.identity);
}

PreparedBake prepare(const Options& o) {
  Inputs in;
  const std::vector<std::byte> bytes = read_file(o.model);
  in.character = read_character(o.input, with_stored_meshes(o.reading, o.model, bytes, o.common), o.common);
  require_clips(o.task.clips, in.character);
  in.model = naming_file(o.model, [&] { return bake::model_of_character(bytes, in.character); });
  naming_file(o.input, [&] {
    in.frames = bake::frames_of(in.character, o.task);
    in.identity = bake::identify_clips(in.character, bytes, o.task);
  });
  const bake::BakeIdentity identity = in.identity;
  return {identity, [&o, in = std::move(in)] {
            // The table has one line for each row, so error_of_modes, which is a list, is only in the report.
            return one_row(naming_file(o.input, [&] { return bake(o, in); }), {"error_of_modes"});
          }};
}

void run(Options o) {
  o.task.tables.seed = o.common.seed;
  run_bake({o.common, o.baking, {{{"the character", o.input}, {"the model", o.model}}, {}, {}}},
           [&] { return prepare(o); });
}

}  // namespace

void add_bake_clips(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "clips",
      "bake a character's clips: their poses and their ray-traced AO.\nThe result is a small file with one "
      "entry per frame. A crowd that is drawn from this file needs no bones on the CPU.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("input", o.input, "the character, a .glb or .gltf file").required();
  command.add_input("model", o.model, "the model that was baked from the character, a .nook file").required();
  add_bake_options(command, o.baking);
  command
      .add_option("--clips", o.task.clips,
                  "bake only these clips; separate their names by commas. Default: all clips except T-poses "
                  "and A-poses")
      .delimiter(',');
  command
      .add_option("--frames-per-second", o.task.frames_per_second,
                  "number of frames to bake per second of a clip")
      .check(in_range(0.1, 1000.0))
      .capture_default_str();
  command.add_option("--rays", o.task.rays, "number of rays per vertex and frame")
      .check(in_range(1, 65536))
      .capture_default_str();
  command
      .add_option("--max-error", o.task.tables.max_error,
                  "largest root mean square error of AO, on a scale from 0 to 1. The bake stores as many AO "
                  "modes as are needed to stay below it")
      .check(in_range(1e-4, 1.0))
      .capture_default_str();
  command
      .add_option("--max-bytes", o.task.tables.max_bytes,
                  "largest size of the file, in bytes per frame and vertex. The bake leaves out AO modes "
                  "that would exceed it, even if the error is then above --max-error")
      .check(in_range(1e-4, 100.0))
      .capture_default_str();
  command
      .add_option("--max-modes", o.task.tables.max_modes,
                  "largest number of AO modes, a multiple of 4. A mode is one of the AO patterns over the "
                  "body that are mixed for each frame")
      .check(in_range(4u, ClipSet::max_ao_modes))
      .capture_default_str();
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
