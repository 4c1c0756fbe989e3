// `nook bake synthesis` makes a coordinate texture that spreads a material over a plane.
#include <memory>

#include "bakers/job/synthesis_bake.h"
#include "bakers/measure/material/plane_picture.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/container.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::tool {
namespace {

struct Options {
  CommonOptions common;
  BakeOptions baking;
  std::filesystem::path input, images;
  std::vector<std::uint32_t> crop;
  bool is_tiling = true;
  bake::synthesis::SynthesisSettings settings;
};

// For a compressed material, draws the plane without and with its coordinates.
void write_pictures(const Options& o, std::span<const std::byte> material, const bake::Crop& crop,
                    const bake::BakedFile& file) {
  if (o.images.empty() || container_kind(material) != nook::material::material_kind.kind) return;
  const auto tables =
      nook::material::make_tables(nook::material::read_material(material), {}, default_memory());
  const auto coordinates = nook::synthesis::read_coordinates(file.model);
  const std::string name = as_file_name(o.input.stem().string());
  bake::write_png(o.images / (name + "_synthesis.png"),
                  measure::plane_sheet(tables, coordinates, {crop.x, crop.y, crop.width, crop.height}));
}

PreparedBake prepare(const Options& o) {
  const bake::Crop crop =
      o.crop.empty() ? bake::Crop{} : bake::Crop{o.crop[0], o.crop[1], o.crop[2], o.crop[3]};
  std::vector<std::byte> material = read_file(o.input);
  bake::SynthesisTask task =
      naming_file(o.input, [&] { return bake::synthesis_task(material, crop, o.is_tiling, o.settings); });
  task.source = o.input.filename().string();
  const bake::BakeIdentity identity = bake::identify_synthesis(task);
  return {identity, [&o, material = std::move(material), task = std::move(task)] {
            platform::ProgressBar bar(o.common.quiet);
            bake::BakedFile file =
                bake::bake_synthesis_file(task, [&](bake::JobStage, std::size_t done, std::size_t total) {
                  bar.show("synthesis", "texels", done, total);
                  return !interrupted();
                });
            write_pictures(o, material, task.crop, file);
            return one_row(std::move(file));
          }};
}

void run(Options& o) {
  o.settings.seed = o.common.seed;
  BakeCommand command{o.common, o.baking, {{{"the input", o.input}}, {}, o.images}};
  command.makes_more = !o.images.empty();
  run_bake(std::move(command), [&] { return prepare(o); });
}

}  // namespace

void add_bake_synthesis(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "synthesis",
      "spread a material over a plane without visible repeats.\nThe result is a texture of coordinates. For "
      "each texel of the plane, it stores the texel of the material to show there.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_input(
          "input", o.input,
          "the material: a .nook file that `nook bake material` wrote, or the file of its option --keep-raw")
      .required();
  add_bake_options(command, o.baking);
  command
      .add_option("--size", o.settings.side,
                  "number of texels along a side of the plane, a multiple of 64. The plane repeats after "
                  "this many texels")
      .check(in_range(bake::synthesis::side_step, nook::synthesis::max_side))
      .capture_default_str();
  command.add_flag("!--no-tile", o.is_tiling,
                   "give this if the material does not tile: it has a visible seam where its borders meet, "
                   "as measured materials have");
  command
      .add_option(
          "--crop", o.crop,
          "use only this part of the material, as X Y WIDTH HEIGHT in texels. Default: the whole material")
      .expected(4);
  command
      .add_option("--jitter", o.settings.jitter,
                  "how far parts of the material move at random, 0 to 1. More movement gives fewer repeats, "
                  "but more seams")
      .check(in_range(0.0f, 1.0f))
      .capture_default_str();
  command
      .add_option("--passes", o.settings.passes,
                  "number of correction passes at each level, from coarse to fine")
      .check(in_range(1u, 16u))
      .capture_default_str();
  command.add_option("--images", o.images,
                     "for a .nook material: write a PNG file into this folder that shows the plane with and "
                     "without the coordinates");
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
