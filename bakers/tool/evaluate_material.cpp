// nook evaluate material: a compressed material against the raw one, beside its baselines, with pictures and
// plots.
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/measure/material/baselines.h"
#include "bakers/measure/material/pictures.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/image_folder.h"
#include "bakers/tool/input_file.h"
#include "bakers/tool/material/options.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "sdk/src/material/material_check.h"

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
  std::vector<std::uint32_t> sweep;
  std::vector<std::string> methods;  // baselines; empty: all, where baselines are requested
  bool peers = false, seeding = false, jumps = false, mipmaps = false, grazing = false;
  std::uint32_t votf_refits = 2;
  nook::material::ModeForm form;  // of what is drawn
};

const std::map<std::string, nook::material::BlockForm> block_forms = {
    {"plain", nook::material::BlockForm::none},
    {"rgtc", nook::material::BlockForm::rgtc},
    {"eac", nook::material::BlockForm::eac}};

void add_sweep(const RawMaterial& raw, const CompressionSettings& settings, const Options& o,
               const measure::MethodProgress& progress, Json& report) {
  const measure::Sweep sweep = measure::measure_sweep(raw, settings, o.sweep, progress);
  report["sweep"] = measure::sweep_rows(sweep, raw.name);
  report["crossing_rank_n_svd"] = measure::crossing_rank(sweep.series[0]);
  report["crossing_rank_k_cta_3"] = measure::crossing_rank(sweep.series[3]);
  if (o.images.empty()) return;
  const char* names[] = {"se", "distance", "forms"};
  const std::vector<measure::Chart> charts = measure::sweep_charts(sweep, raw.name);
  for (std::size_t i = 0; i < charts.size(); ++i)
    platform::OutputFile(o.images / (as_file_name(raw.name) + "_sweep_" + names[i] + ".svg"))
        .commit(measure::chart_svg(charts[i]));
}

// The pictures of --images: one of each material, and one of all side by side.
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
  std::vector<Material> materials_;  // the file first
  std::vector<bake::Picture> jumps_;
};

std::vector<std::string> baselines_of(const Options& o) {
  return o.methods.empty() && o.peers ? measure::material_peer_names() : o.methods;
}

// Baselines of bytes or of texels need no ranks of the file.
bool fits_at_equal_ranks(const Options& o) {
  const auto needs_ranks = [](const std::string& name) {
    return name != "pca" && name != "pbr" && name != "neural";
  };
  return o.seeding || !o.sweep.empty() || std::ranges::any_of(baselines_of(o), needs_ranks);
}

RawMaterial read_raw(const std::filesystem::path& path) {
  return naming_file(path, [&] { return bake::material::read_raw_material(read_file(path)); });
}

Json evaluate(const Options& o) {
  platform::ProgressBar bar(o.common.quiet);
  const measure::MethodProgress progress = [&bar](const std::string& method) {
    return stage_progress(bar, method);
  };
  const RawMaterial raw = read_raw(o.raw);
  const std::vector<std::byte> bytes = read_file(o.material);
  const Material material = naming_file(o.material, [&] { return nook::material::read_material(bytes); });
  if (fits_at_equal_ranks(o))
    nook::material::refuse_neural(material.neural.is_used(), "a fit at equal ranks");
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
  Json rows = Json::array({bake::material::report_row(raw.name, own)});
  Pictures pictures(o, raw);
  pictures.add("file", material, own);
  measure::BaselineRequest request;
  request.names = baselines_of(o);
  request.unseen = unseen;
  request.jumps = o.jumps;
  request.votf_refits = o.votf_refits;
  request.progress = progress;
  request.keep = [&](const std::string& name, const Material& compressed, const MethodRow& row) {
    pictures.add(name, compressed, row);
  };
  for (const Json& row : measure::material_baseline_rows(raw, file, o.common.seed, request))
    rows.push_back(row);
  pictures.write_sheets();
  CompressionSettings settings = measure::settings_of(material, o.common.seed);
  settings.votf_refits = o.votf_refits;
  Json report;
  report["rows"] = rows;
  report["settings"] = describe(settings);
  if (o.form.blocks != nook::material::BlockForm::none) {
    report["settings"]["modes"] = o.form.blocks == nook::material::BlockForm::rgtc ? "rgtc" : "eac";
    report["settings"]["whole_light_modes"] = o.form.whole_light_modes;
  }
  if (o.seeding) report["seeding"] = measure::seeding_rows(raw, settings, progress);
  if (!o.sweep.empty()) add_sweep(raw, settings, o, progress, report);
  return report;
}

void add_mode_options(Command command, nook::material::ModeForm& form) {
  command
      .add_choice("--modes", form.blocks, block_forms,
                  "draw with spatial modes as the file has them (plain), or in blocks of a context: rgtc or "
                  "eac; for all that is measured as it is drawn")
      .type_name("FORM");
  command
      .add_option("--whole-light-modes", form.whole_light_modes,
                  "with blocks, the first light modes that stay whole, in steps of 4")
      .check(in_range(0u, nook::material::max_light_modes))
      .capture_default_str();
}

}  // namespace

void add_evaluate_material(Command evaluate_command) {
  const Command command =
      evaluate_command.add_subcommand("material", "measure a compressed material against the raw one");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_option("raw", o.raw, "the raw material, written by `bake material --keep-raw`").required();
  command.add_option("material", o.material, "the .nook file").required();
  command.add_flag(
      "--peers", o.peers,
      "compress by N-SVD, CTA, K-CTA with K = 2, 3, 4 at the file's ranks, by N-SVD and PCA at the bytes of "
      "the whole file, and fit the maps of a physically based material with parallax");
  command
      .add_option("--methods", o.methods,
                  "only these baselines: n-svd, cta, k-cta-2, k-cta-3, k-cta-4, n-svd-filled, pca, pbr, and "
                  "neural, networks of a small size and of the bytes of the whole file, which train for "
                  "minutes and are not among those of --peers")
      .delimiter(',')
      .check(one_of(measure::material_baseline_names()))
      .type_name("NAME,...");
  command.add_option("--unseen", o.unseen,
                     "a raw material of other views, and of other lights where they differ, for the error "
                     "between the samples");
  command
      .add_option("--votf-refits", o.votf_refits,
                  "further fits of the VOTF of the methods beside the file, as in bake material")
      .check(in_range(0, 16))
      .capture_default_str();
  command.add_flag(
      "--jumps", o.jumps,
      "measure jumps as the view moves by 0.1 degrees, with and without view maps, which CTA has "
      "then as well; with --images a picture of the largest of each method");
  command.add_flag(
      "--mipmaps", o.mipmaps,
      "measure pixels that cover 2 x 2, 4 x 4 and more texels, at their mipmap level and at the finest");
  command.add_flag(
      "--grazing", o.grazing,
      "measure pixels of views between 60 and 85 degrees against supersampling, with 1 to 8 fetches along "
      "them");
  add_mode_options(command, o.form);
  command.add_flag("--compare-seeding", o.seeding, "CTA and K-CTA from clusters of directions and of values");
  command.add_option("--sweep", o.sweep, "total view ranks, for all methods (plots with --images)")
      .delimiter(',');
  command.add_option("--images", o.images, "write pictures and plots to this folder");
  add_common_options(command, o.common);
  command.callback([options] {
    const CommandFiles files{{{"the raw material", options->raw},
                              {"the material", options->material},
                              {"--unseen", options->unseen}},
                             {},
                             options->images};
    run_evaluation(options->common, files, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
