// nook-lab evaluate material: the same command as in nook, plus the methods that compressed materials are
// compared with.
#include <algorithm>

#include "bakers/lab/material/material_peers.h"
#include "bakers/lab/material/rank_sweep.h"
#include "bakers/lab/tool/lab_commands.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/peers.h"
#include "platform/output_file.h"
#include "sdk/src/material/material_check.h"

namespace nook::lab {
namespace {

using tool::Command;
using tool::MaterialEvaluation;
using Json = nlohmann::ordered_json;

constexpr const char* no_method = "none";

std::vector<std::string> choices() {
  std::vector<std::string> names = material_baseline_names();
  names.emplace_back(no_method);
  return names;
}

class Peers : public tool::MaterialPeers {
 public:
  void add_options(Command command) override {
    command
        .add_option(
            "--methods", methods_,
            "compare the file with these methods; separate them by commas. n-svd, cta, k-cta-2, k-cta-3 and "
            "k-cta-4 have the same ranks as the file. n-svd-filled and pca have the same size in bytes. pbr "
            "uses material maps with parallax. neural trains two networks for minutes: a small one, and one "
            "of the same size as the file. none compares with nothing. Default: all but neural")
        .delimiter(',')
        .check(tool::one_of(choices()))
        .type_name("NAME,...");
    command
        .add_option("--votf-refits", votf_refits_,
                    "for the other methods: number of additional fits of the visibility, like --votf-refits "
                    "of `nook bake material`")
        .check(tool::in_range(0, 16))
        .capture_default_str();
    command.add_flag("--compare-seeding", seeding_,
                     "also compare two ways to group views into the first clusters, for CTA and K-CTA: by "
                     "directions and by values");
    command
        .add_option("--sweep", sweep_,
                    "also measure all methods at these view ranks (of all clusters together); separate them "
                    "by commas. --images plots the results")
        .delimiter(',');
  }

  // Rejects a neural material if one of the methods needs the ranks of the file, which a neural material does
  // not have. Methods whose size is given in bytes or texels do not need the ranks.
  void check(const nook::material::Material& material) const override {
    const auto needs_ranks = [](const std::string& name) {
      return name != "pca" && name != "pbr" && name != "neural";
    };
    if (seeding_ || !sweep_.empty() || std::ranges::any_of(names(), needs_ranks))
      nook::material::refuse_neural(material.neural.is_used(), "a fit at equal ranks");
  }

  void measure(const MaterialEvaluation& e, Json& report) const override {
    BaselineRequest request;
    request.names = names();
    request.unseen = e.unseen;
    request.jumps = e.jumps;
    request.votf_refits = votf_refits_;
    request.progress = e.progress;
    request.keep = e.draw;
    for (const Json& row : material_baseline_rows(e.raw, e.file, e.seed, request))
      report["rows"].push_back(row);
    CompressionSettings settings = e.settings;
    settings.votf_refits = votf_refits_;
    Json& described = report["settings"];
    if (described.contains("votf_refits")) described["votf_refits"] = votf_refits_;
    if (seeding_) report["seeding"] = seeding_rows(e.raw, settings, e.progress);
    if (!sweep_.empty()) add_sweep(e, settings, report);
  }

 private:
  std::vector<std::string> names() const {
    if (methods_.empty()) return material_peer_names();
    std::vector<std::string> wanted = methods_;
    std::erase(wanted, no_method);
    return wanted;
  }

  void add_sweep(const MaterialEvaluation& e, const CompressionSettings& settings, Json& report) const {
    const Sweep sweep = measure_sweep(e.raw, settings, sweep_, e.progress);
    report["sweep"] = sweep_rows(sweep, e.raw.name);
    report["crossing_rank_n_svd"] = crossing_rank(sweep.series[0]);
    report["crossing_rank_k_cta_3"] = crossing_rank(sweep.series[3]);
    if (e.images.empty()) return;
    const char* names[] = {"se", "distance", "forms"};
    const std::vector<Chart> charts = sweep_charts(sweep, e.raw.name);
    for (std::size_t i = 0; i < charts.size(); ++i)
      platform::OutputFile(e.images / (tool::as_file_name(e.raw.name) + "_sweep_" + names[i] + ".svg"))
          .commit(chart_svg(charts[i]));
  }

  std::vector<std::uint32_t> sweep_;
  std::vector<std::string> methods_;  // as given
  bool seeding_ = false;
  std::uint32_t votf_refits_ = 2;
};

}  // namespace

void add_evaluate_material(Command evaluate) {
  tool::add_evaluate_material(evaluate, std::make_shared<Peers>());
}

}  // namespace nook::lab
