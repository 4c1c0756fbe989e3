// nook bake probe SCENE --grid AxBxC --light MAP: a grid of probes by path tracing, refined until its error
// is small.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/job/probe_bake.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/output_file.h"
#include "bakers/tool/probe/bake.h"
#include "bakers/tool/probe/scene.h"
#include "bakers/tool/progress_bar.h"
#include "bakers/tool/table.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using bake::probe::GridBake;
using bake::probe::GridBakeSettings;

constexpr std::uint32_t default_samples = 65536;

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

std::vector<std::byte> file_of(const BakeProbeOptions& options, GridBake& grid, double error) {
  probe::Probes probes = grid.probes();
  Json recipe = describe(options.probe, probes.basis);
  recipe["source"] = options.input.filename().string();
  recipe["light"] = options.light.filename().string();
  recipe["samples"] = grid.samples();
  recipe["error"] = error;
  recipe["seed"] = options.common.seed;
  probes.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace);
  return probe::write_probes(probes, packing_of(options.probe));
}

// Passes until the error is small enough, the samples are used up, or the user stops it.
double refine(const BakeProbeOptions& options, GridBake& grid, std::uint32_t max_passes) {
  ProgressBar bar(options.common.quiet);
  bake::GridRefinement refinement;
  refinement.max_passes = max_passes;
  refinement.error = options.error;
  refinement.preview_every_s = options.preview_every_s;
  refinement.progress = [&](std::size_t done, std::size_t total) {
    bar.show("path tracing", "passes at most", done, total);
    return !interrupted();
  };
  refinement.preview = [&](double error) {
    OutputFile(options.output).commit(file_of(options, grid, error));
    char label[64];
    std::snprintf(label, sizeof label, "preview written, error %.3g", error);
    bar.show(label, "passes at most", grid.passes(), max_passes);
  };
  return bake::refine_grid(grid, refinement);
}

}  // namespace

void bake_probe_grid(const BakeProbeOptions& options) {
  OutputFile output(options.output);
  std::optional<OutputFile> report;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  const bake::ProbeScene scene = read_probe_scene(options.input, options.light, !options.no_textures);
  GridBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.grid = bake::probe::grid_in_box(options.grid, options.has_box ? options.box_low_ws : scene.low_ws,
                                           options.has_box ? options.box_high_ws : scene.high_ws);
  settings.seed = options.common.seed;
  settings.path.max_bounces = options.max_bounces;
  settings.path.origin_offset = scene.origin_offset;

  const auto began = Clock::now();
  GridBake bake(*scene.lit, settings);
  const std::uint32_t samples = options.samples > 0 ? options.samples : default_samples;
  const std::uint32_t passes = (samples + settings.samples_per_pass - 1) / settings.samples_per_pass;
  const double error = refine(options, bake, passes);
  const std::vector<std::byte> bytes = file_of(options, bake, error);
  Json row;
  row["scene"] = options.input.stem().string();
  row["light"] = options.light.stem().string();
  row["probes"] = settings.grid.size();
  row["probes_inside"] = bake.inside_count();
  const Json made_of = describe(options.probe, settings.basis);
  for (const auto& item : made_of.items()) row[item.key()] = item.value();
  row["samples_per_probe"] = bake.samples();
  row["error"] = error;
  row["error_reached"] = error <= options.error;
  row["bytes"] = bytes.size();
  row["seconds"] = seconds_since(began);
  row["paths_per_s"] =
      double(bake.samples()) * double(settings.grid.size() - bake.inside_count()) / seconds_since(began);
  output.commit(bytes);
  const Json rows = Json::array({row});
  if (report) report->commit(Json{{"rows", rows}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!options.common.quiet) std::fputs(table_text(rows).c_str(), stdout);
}

}  // namespace nook::tool
