// nook bake probe SCENE --grid AxBxC --light MAP: a grid of probes by path tracing, refined until its error
// is small.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/probe/bake.h"
#include "cli/probe/scene.h"
#include "cli/progress_bar.h"
#include "cli/table.h"
#include "probe/grid_bake.h"
#include "probe/probe_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using bake::probe::GridBake;
using bake::probe::GridBakeSettings;

constexpr std::uint32_t default_samples = 65536;
constexpr std::uint32_t passes_between_errors = 4;

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

std::vector<std::byte> file_of(const BakeProbeOptions& options, GridBake& bake, double error) {
  probe::Probes probes = bake.probes();
  Json recipe = describe(options.probe, probes.basis);
  recipe["source"] = options.input.filename().string();
  recipe["light"] = options.light.filename().string();
  recipe["direct"] = options.direct;
  recipe["samples"] = bake.samples();
  recipe["error"] = error;
  recipe["seed"] = options.common.seed;
  probes.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace);
  return probe::write_probes(probes, packing_of(options.probe));
}

// Passes until the error is small enough, the samples are used up, or the user stops it.
double refine(const BakeProbeOptions& options, GridBake& bake, std::uint32_t most_passes) {
  ProgressBar bar(options.common.quiet);
  double error = 1;
  auto previewed = Clock::now();
  while (bake.passes() < most_passes && error > options.error) {
    bar.show("path tracing", "passes at most", bake.passes(), most_passes);
    if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while path tracing");
    bake.pass();
    if (bake.passes() % passes_between_errors == 0) error = bake.error();
    if (options.preview_every_s > 0 && seconds_since(previewed) >= options.preview_every_s) {
      error = bake.error();
      OutputFile(options.output).commit(file_of(options, bake, error));
      char label[64];
      std::snprintf(label, sizeof label, "preview written, error %.3g", error);
      bar.show(label, "passes at most", bake.passes(), most_passes);
      previewed = Clock::now();
    }
  }
  return bake.error();
}

}  // namespace

void bake_probe_grid(const BakeProbeOptions& options) {
  OutputFile output(options.output);
  std::optional<OutputFile> report;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  const ProbeScene scene = read_probe_scene(options.input, options.light, !options.no_textures);
  GridBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.grid = bake::probe::grid_in_box(options.grid, options.has_box ? options.box_low_ws : scene.low_ws,
                                           options.has_box ? options.box_high_ws : scene.high_ws);
  settings.seed = options.common.seed;
  settings.path.max_bounces = options.max_bounces;
  settings.path.origin_offset = scene.origin_offset;
  settings.path.direct = direct_of(options.direct);

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
  row["direct"] = options.direct;
  if (settings.path.direct != bake::DirectLight::all) row["suns"] = describe_suns(scene.lit->environment());
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

}  // namespace nook::cli
