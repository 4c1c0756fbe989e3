// `nook evaluate material` compares a compressed material with the raw one, and draws pictures.
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/measure/material/material_pictures.h"
#include "bakers/measure/material/material_report.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/compression_options.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/peers.h"
#include "platform/progress_bar.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"

namespace nook::tool {
namespace {

using bake::material::CompressionSettings;
using bake::material::MethodRow;
using bake::material::RawMaterial;
using nook::material::Material;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path raw, material, unseen, images;
  bool jumps = false, mipmaps = false, grazing = false;
  nook::material::ModeForm form;  // number format of the drawn modes
};

const std::map<std::string, nook::material::BlockForm> block_forms = {
    {"plain", nook::material::BlockForm::none},
    {"rgtc", nook::material::BlockForm::rgtc},
    {"eac", nook::material::BlockForm::eac}};

// Draws the pictures of --images: one for each material, and one with all materials side by side.
class Pictures {
 public:
  Pictures(const Options& o, const RawMaterial& raw) : o_(o), raw_(raw) {}

  void add(const std::string& name, const Material& material, const MethodRow& row) {
    if (o_.images.empty()) return;
    write(name, measure::difference_sheet(raw_, material));
    if (row.jumps) jumps_.push_back(measure::jump_strip(material, *row.jumps));
    materials_.push_back(material);
  }
  void write_sheets() const {
    if (o_.images.empty()) return;
    write("raw", measure::raw_sheet(raw_));
    if (materials_.size() > 1) write("methods", measure::methods_sheet(raw_, materials_));
    if (!jumps_.empty()) write("jumps", measure::below_each_other(jumps_));
  }

 private:
  void write(const std::string& name, const bake::Picture& picture) const {
    bake::write_png(o_.images / (as_file_name(raw_.name) + "_" + name + ".png"), picture);
  }

  const Options& o_;
  const RawMaterial& raw_;
  std::vector<Material> materials_;  // the file's material comes first
  std::vector<bake::Picture> jumps_;
};

RawMaterial read_raw(const std::filesystem::path& path) {
  return naming_file(path, [&] { return bake::material::read_raw_material(read_file(path)); });
}

Json evaluate(const Options& o, const MaterialPeers* peers) {
  platform::ProgressBar bar(o.common.quiet);
  const measure::MethodProgress progress = [&bar](const std::string& method) {
    return stage_progress(bar, method);
  };
  const RawMaterial raw = read_raw(o.raw);
  const std::vector<std::byte> bytes = read_file(o.material);
  const Material material = naming_file(o.material, [&] { return nook::material::read_material(bytes); });
  if (peers) peers->check(material);
  const measure::MaterialFile file{bytes, material};
  bar.show("measuring", "files", 0, 1);
  RawMaterial unseen_material;
  const RawMaterial* unseen = nullptr;
  if (!o.unseen.empty()) {
    unseen_material = read_raw(o.unseen);
    unseen = &unseen_material;
  }
  const MethodRow own = naming_file(o.material, [&] {
    return measure::material_file_row(raw, file, {unseen, o.jumps, o.mipmaps, o.grazing, o.form});
  });
  Pictures pictures(o, raw);
  pictures.add("file", material, own);
  const CompressionSettings settings = measure::settings_of(material, o.common.seed);
  Json report;
  report["rows"] = Json::array({bake::material::report_row(raw.name, own)});
  report["settings"] = describe(settings);
  if (o.form.blocks != nook::material::BlockForm::none) {
    report["settings"]["modes"] = o.form.blocks == nook::material::BlockForm::rgtc ? "rgtc" : "eac";
    report["settings"]["whole_light_modes"] = o.form.whole_light_modes;
  }
  if (peers)
    peers->measure({raw, file, unseen, o.jumps, o.common.seed, settings, o.images, progress,
                    [&](const std::string& name, const Material& compressed, const MethodRow& row) {
                      pictures.add(name, compressed, row);
                    }},
                   report);
  pictures.write_sheets();
  return report;
}

void add_mode_options(Command command, nook::material::ModeForm& form) {
  command
      .add_choice("--modes", form.blocks, block_forms,
                  "format of the textures that store the spatial modes of the material: plain (default, as "
                  "in the file), or the block compression rgtc or eac")
      .type_name("FORM");
  command
      .add_option("--whole-light-modes", form.whole_light_modes,
                  "for --modes rgtc and eac: number of the first light modes that are not compressed in "
                  "blocks, a multiple of 4")
      .check(in_range(0u, nook::material::max_light_modes))
      .capture_default_str();
}

}  // namespace

void add_evaluate_material(Command evaluate_command) {
  add_evaluate_material(evaluate_command, nullptr);
}

void add_evaluate_material(Command evaluate_command, std::shared_ptr<MaterialPeers> peers) {
  const Command command = evaluate_command.add_subcommand(
      "material", "measure a compressed material against the uncompressed (raw) one");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_input("raw", o.raw, "the uncompressed material, a file that `nook bake material --keep-raw` wrote")
      .required();
  command.add_input("material", o.material, "the compressed material, a .nook file").required();
  command.add_input(
      "--unseen", o.unseen,
      "also measure the error in views that the material does not store. Give the same material with other "
      "views (and lights, if you like), a file that `nook bake material --keep-raw` wrote");
  command.add_flag("--jumps", o.jumps,
                   "also measure how much the picture changes when the view turns by 0.1 degrees, with and "
                   "without the view map. --images draws the largest change");
  command.add_flag("--mipmaps", o.mipmaps,
                   "also measure pixels that cover 2 x 2, 4 x 4 and more texels, with and without mipmaps");
  command.add_flag("--grazing", o.grazing,
                   "also measure pixels at view angles of 60 to 85 degrees from the normal, against "
                   "supersampling, with 1 to 8 fetches along the pixel");
  add_mode_options(command, o.form);
  command.add_option(
      "--images", o.images,
      "write PNG files into this folder: the raw material, the decoded material and their difference");
  if (peers) peers->add_options(command);
  add_common_options(command, o.common);
  command.callback([options, peers] {
    const CommandFiles files{{{"the raw material", options->raw},
                              {"the material", options->material},
                              {"--unseen", options->unseen}},
                             {},
                             options->images};
    run_evaluation(options->common, files, [&] { return evaluate(*options, peers.get()); });
  });
}

}  // namespace nook::tool
