// nook evaluate material: a compressed material against the raw one, beside its peers, with pictures and
// plots.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/input_file.h"
#include "cli/material/options.h"
#include "cli/material/pictures.h"
#include "cli/material/sweep.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "material/material_file.h"
#include "material/raw_file.h"
#include "material/unseen_views.h"
#include "material/whole_file.h"

namespace nook::cli {
namespace {

using namespace bake::material;
using nook::material::Material;
using nook::material::VisibilityForm;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path raw, material, unseen, images;
  std::vector<std::uint32_t> sweep;
  std::vector<std::string> methods;  // peers; empty: all, where peers are asked for
  bool peers = false, seeding = false;
};

// The settings that a material's sizes tell.
CompressionSettings settings_of(const Material& material, const Options& o) {
  const auto &btf = material.btf.shape, &votf = material.votf.shape;
  CompressionSettings s;
  s.rank_light = btf.rank_light;
  s.rank_view = btf.rank_view * btf.clusters;
  s.rank_x = btf.rank_x;
  s.rank_y = btf.rank_y;
  s.cluster_rank_view = btf.clusters > 1 ? btf.rank_view : 4;
  s.visibility = material.visibility;
  if (material.visibility != VisibilityForm::none) {
    s.votf_rank_x = votf.rank_x;
    s.votf_rank_y = votf.rank_y;
  }
  if (btf.clusters > 1 && btf.mixture > 1) s.map_side = material.btf.map.side;
  s.seed = o.common.seed;
  return s;
}

struct Peer {
  const char* name;
  Method method;
  std::uint32_t mixture;
};
constexpr Peer peers[] = {{"n-svd", Method::n_svd, 1},
                          {"cta", Method::cta, 1},
                          {"k-cta-2", Method::k_cta, 2},
                          {"k-cta-3", Method::k_cta, 3},
                          {"k-cta-4", Method::k_cta, 4}};
constexpr const char *pca_name = "pca", *n_svd_filled_name = "n-svd-filled";

bool wanted(const Options& o, const std::string& name) {
  return o.methods.empty() ? o.peers : std::find(o.methods.begin(), o.methods.end(), name) != o.methods.end();
}

// The raw material in views that the fit has not seen; without directions where none is given.
RawMaterial read_unseen(const Options& o) {
  if (o.unseen.empty()) return {};
  return naming_file(o.unseen, [&] { return read_raw_material(read_file(o.unseen)); });
}

void add_unseen(const RawMaterial& unseen, const Material& material, const Options& o, MethodRow& row) {
  if (unseen.views.empty()) return;
  const UnseenError error = naming_file(o.unseen, [&] { return measure_unseen(unseen, material); });
  row.se_db_unseen = error.se_db;
  row.error_texels_unseen = error.error_texels;
}

// The view rank at which an N-SVD takes as many bytes as a file, its recipe counted: the text of the greatest
// rank is the longest.
std::uint32_t filling_view_rank(const RawMaterial& raw, CompressionSettings s, std::size_t file_bytes) {
  s.method = Method::n_svd;
  s.rank_view = std::uint32_t(raw.views.size());
  const std::size_t recipe = describe(s).dump().size();
  return file_bytes > recipe ? n_svd_view_rank(raw, s, file_bytes - recipe) : 0;
}

// What the compared file is measured against.
struct Compared {
  const RawMaterial &raw, &unseen;
  std::span<const std::byte> file;
  CompressionSettings settings;
};

void add_tensor(const Compared& c, const CompressionSettings& s, const char* name, const Options& o,
                ProgressBar& bar, Json& rows) {
  Material material;
  MethodRow row = measure_method(c.raw, s, stage_progress(bar, std::string(name) + ", "), &material);
  add_unseen(c.unseen, material, o, row);
  rows.push_back(report_row(c.raw.name, row));
  if (!o.images.empty())
    bake::write_png(o.images / (c.raw.name + "_" + name + ".png"), difference_sheet(c.raw, material));
}

void add_peers(const Compared& c, const Options& o, ProgressBar& bar, Json& rows) {
  for (const Peer& peer : peers) {
    CompressionSettings s = c.settings;
    s.method = peer.method;
    s.mixture = peer.mixture;
    if (!wanted(o, peer.name) || (s.method == Method::k_cta && s.mixture > s.cluster_count())) continue;
    add_tensor(c, s, peer.name, o, bar, rows);
  }
  const std::uint32_t rank = filling_view_rank(c.raw, c.settings, c.file.size());
  if (wanted(o, n_svd_filled_name) && rank > 0) {
    CompressionSettings s = c.settings;
    s.method = Method::n_svd;
    s.rank_view = rank;
    add_tensor(c, s, n_svd_filled_name, o, bar, rows);
    rows.back()["method"] = "N-SVD, equal bytes";
  }
  if (!wanted(o, pca_name)) return;
  bar.show("principal components", "steps", 0, 1);
  rows.push_back(report_row(c.raw.name, measure_pca(c.raw, c.file, c.settings.seed)));
}

void add_seedings(const RawMaterial& raw, const CompressionSettings& settings, ProgressBar& bar,
                  Json& report) {
  Json rows = Json::array();
  for (const Seeding seeding : {Seeding::directions, Seeding::values})
    for (const std::uint32_t mixture : {1u, 3u}) {
      CompressionSettings s = settings;
      s.seeding = seeding;
      s.method = mixture == 1 ? Method::cta : Method::k_cta;
      s.mixture = mixture;
      if (mixture > s.cluster_count()) continue;
      const char* name = seeding == Seeding::directions ? "directions" : "values";
      rows.push_back(report_row(
          raw.name, measure_method(raw, s, stage_progress(bar, std::string("seeds of ") + name + ", "))));
      rows.back()["seeding"] = name;
    }
  report["seeding"] = rows;
}

void add_sweep(const RawMaterial& raw, const CompressionSettings& settings, const Options& o,
               ProgressBar& bar, Json& report) {
  const Sweep sweep = measure_sweep(raw, settings, o.sweep, bar);
  report["sweep"] = sweep_rows(sweep, raw.name);
  report["crossing_rank_n_svd"] = crossing_rank(sweep.series[0]);
  report["crossing_rank_k_cta_3"] = crossing_rank(sweep.series[3]);
  if (o.images.empty()) return;
  const char* names[] = {"se", "distance", "forms"};
  const std::vector<Chart> charts = sweep_charts(sweep, raw.name);
  for (std::size_t i = 0; i < charts.size(); ++i)
    OutputFile(o.images / (raw.name + "_sweep_" + names[i] + ".svg")).commit(chart_svg(charts[i]));
}

Json evaluate(const Options& o) {
  ProgressBar bar(o.common.quiet);
  const RawMaterial raw = naming_file(o.raw, [&] { return read_raw_material(read_file(o.raw)); });
  const std::vector<std::byte> file = read_file(o.material);
  const Material material = naming_file(o.material, [&] { return nook::material::read_material(file); });
  if (!o.images.empty()) std::filesystem::create_directories(o.images);
  bar.show("measuring", "files", 0, 1);
  const RawMaterial unseen = read_unseen(o);
  MethodRow own = naming_file(o.material, [&] { return measure_material(raw, material); });
  own.method = "file: " + own.method;
  own.file_bytes = file.size();
  add_unseen(unseen, material, o, own);
  Json rows = Json::array({report_row(raw.name, own)});
  if (!o.images.empty()) {
    bake::write_png(o.images / (raw.name + "_raw.png"), raw_sheet(raw));
    bake::write_png(o.images / (raw.name + "_file.png"), difference_sheet(raw, material));
  }
  const CompressionSettings settings = settings_of(material, o);
  Json report;
  add_peers({raw, unseen, file, settings}, o, bar, rows);
  report["rows"] = rows;
  report["settings"] = describe(settings);
  if (o.seeding) add_seedings(raw, settings, bar, report);
  if (!o.sweep.empty()) add_sweep(raw, settings, o, bar, report);
  return report;
}

}  // namespace

void add_evaluate_material(CLI::App& evaluate_command) {
  CLI::App* command =
      evaluate_command.add_subcommand("material", "measure a compressed material against the raw one");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command->add_option("raw", o.raw, "the raw material, written by `bake material --keep-raw`")->required();
  command->add_option("material", o.material, "the .nook file")->required();
  std::vector<std::string> names = {pca_name, n_svd_filled_name};
  for (const Peer& peer : peers) names.emplace_back(peer.name);
  command->add_flag("--peers", o.peers,
                    "compress by N-SVD, CTA, K-CTA with K = 2, 3, 4 at the file's ranks, and by N-SVD and "
                    "PCA at the bytes of the "
                    "whole file");
  command
      ->add_option("--methods", o.methods,
                   "only these peers: n-svd, cta, k-cta-2, k-cta-3, k-cta-4, n-svd-filled, pca")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->type_name("NAME,...");
  command->add_option(
      "--unseen", o.unseen,
      "a raw material of the same lights and other views, for the error between sampled views");
  command->add_flag("--compare-seeding", o.seeding,
                    "CTA and K-CTA from clusters of directions and of values");
  command->add_option("--sweep", o.sweep, "total view ranks, for all methods (plots with --images)")
      ->delimiter(',');
  command->add_option("--images", o.images, "write pictures and plots to this folder");
  add_common_options(*command, o.common);
  command->callback([options] { run_evaluation(options->common, [&] { return evaluate(*options); }); });
}

}  // namespace nook::cli
