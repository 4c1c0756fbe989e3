// `nook bake transfer` bakes radiance transfer for a static shape: how much of each light lobe is visible
// from each vertex.
#include <cstdio>
#include <memory>

#include "bakers/import/sha256.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::tool {
namespace {

struct Options {
  CommonOptions common;
  BakeOptions baking;
  std::filesystem::path input;
  bake::ImportOptions reading;
  bake::transfer::BakeSettings settings;
  std::filesystem::path votf, material;
  std::string form = "separated";
  bake::transfer::PaperSettings paper;
};

bake::TransferTask read_task(const Options& o) {
  bake::ImportedSurface imported =
      naming_file(o.input, [&] { return bake::import_surface(o.input, o.reading); });
  bake::TransferTask task;
  task.mesh = std::move(imported.mesh);
  task.settings = o.settings;
  task.paper = o.paper;
  task.paper.seed = o.common.seed;
  if (o.form == "paper") {
    const std::vector<std::byte> bytes = read_file(o.material);
    task.material = naming_file(o.material, [&] { return bake::tables_of_material(bytes); });
    task.material_hash = bake::sha256(bytes);
    bake::transfer::check_paper_bake(task.mesh, task.paper);
  }
  if (!o.votf.empty())
    task.settings.holes = naming_file(o.votf, [&] { return bake::holes_of_material(read_file(o.votf)); });
  task.source = o.input.filename().string();
  task.meshes = o.reading.meshes;
  task.warnings = std::move(imported.warnings);
  if (!o.common.quiet)
    for (const std::string& warning : task.warnings)
      std::fprintf(stderr, "nook: %s: %s\n", o.input.c_str(), platform::printable_lines(warning).c_str());
  return task;
}

PreparedBake prepare(const Options& o) {
  bake::TransferTask task = read_task(o);
  const bake::BakeIdentity identity = bake::identify_transfer(task);
  return {identity, [&o, task = std::move(task)] {
            platform::ProgressBar bar(o.common.quiet);
            return one_row(bake::bake_transfer_file(
                task, [&](bake::JobStage stage, std::size_t done, std::size_t total) {
                  const bool is_fit = stage == bake::JobStage::fit;
                  bar.show(is_fit ? "fitting" : "ray tracing", is_fit ? "clusters" : "vertices", done, total);
                  return !interrupted();
                }));
          }};
}

void run(const Options& o) {
  if ((o.form == "paper") != !o.material.empty())
    throw ToolError(exit_bad_arguments, o.form == "paper" ? "--form paper needs --material"
                                                          : "--material works only with --form paper");
  CommandFiles files{{{"the input", o.input}}, {}, {}};
  if (!o.material.empty()) files.inputs.push_back({"--material", o.material});
  if (!o.votf.empty()) files.inputs.push_back({"--votf", o.votf});
  run_bake({o.common, o.baking, files}, [&] { return prepare(o); });
}

}  // namespace

void add_bake_transfer(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "transfer",
      "bake how much light from each direction reaches a static shape (radiance transfer).\nAt run time, you "
      "can then light the shape with any environment map. The shadows that the shape casts on itself are "
      "included.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("input", o.input, "the shape, a .glb or .gltf file with texture coordinates").required();
  add_bake_options(command, o.baking);
  command
      .add_option("--lobes", o.settings.lobes,
                  "number of lobes that represent the light. Each takes a byte per vertex in the file")
      .check(in_range(transfer::min_lobes, transfer::max_lobes))
      .capture_default_str();
  command
      .add_option("--ray-side", o.settings.side,
                  "number of rays along each edge of the cube of directions around a vertex. A vertex takes "
                  "6 times the square of this number")
      .check(in_range(8u, bake::transfer::max_ray_side))
      .capture_default_str();
  command
      .add_option("--bounces", o.settings.bounces,
                  "number of bounces of light between parts of the shape. Each bounce adds 18 bytes per "
                  "vertex to the file")
      .check(in_range(0u, transfer::max_bounces))
      .capture_default_str();
  command.add_input("--votf", o.votf,
                    "let light fall through the holes of the material on the shape. Give the .nook file of "
                    "the material. Default: no holes");
  command
      .add_option("--tiles", o.settings.tiles,
                  "number of tiles of the material in --votf per unit of texture coordinates")
      .check(in_range(0.01f, 1000.0f))
      .capture_default_str();
  command
      .add_option("--form", o.form,
                  "form of the result: separated works with any material. paper (Tsai and Shih 2012) works "
                  "only with the material in --material, and stores matrices that are compressed by CTA")
      .check(one_of({"separated", "paper"}))
      .capture_default_str();
  command.add_input("--material", o.material,
                    "for --form paper (required): the .nook file of the material on the shape");
  command
      .add_option("--clusters", o.paper.clusters,
                  "for --form paper: number of clusters of vertices; 0 means one cluster per 360 vertices")
      .check(in_range(0u, transfer::max_clusters))
      .capture_default_str();
  command
      .add_option("--lobe-rank", o.paper.lobe_rank,
                  "for --form paper: number of modes (components) that a cluster keeps for lobes")
      .check(in_range(1u, transfer::max_lobe_rank))
      .capture_default_str();
  command
      .add_option("--vertex-rank", o.paper.vertex_rank,
                  "for --form paper: number of modes (components) that a cluster keeps for vertices")
      .check(in_range(1u, transfer::max_vertex_rank))
      .capture_default_str();
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
