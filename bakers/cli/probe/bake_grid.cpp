// nook bake probe SCENE --grid AxBxC --light MAP: a grid of probes by path tracing, refined until its error
// is small.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/probe/bake.h"
#include "cli/progress_bar.h"
#include "cli/table.h"
#include "import/static_scene.h"
#include "probe/grid_bake.h"
#include "probe/probe_file.h"
#include "raytrace/lit_scene.h"

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

struct Box {
  Vec3 low, high;
};

Box box_of(const std::vector<Vec3>& points) {
  Box box{points.front(), points.front()};
  for (Vec3 p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

std::vector<std::byte> file_of(const BakeProbeOptions& options, GridBake& bake, double error) {
  probe::Probes probes = bake.probes();
  Json recipe = describe(options.probe, probes.basis);
  recipe["source"] = options.input.filename().string();
  recipe["light"] = options.light.filename().string();
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
  bake::StaticScene scene =
      naming_file(options.input, [&] { return bake::import_static_scene(options.input); });
  if (scene.textured > 0 && !options.common.quiet)
    std::fprintf(stderr,
                 "nook: %s: textures of %u materials are not read; their colour factors stand for them\n",
                 options.input.c_str(), scene.textured);
  const Box box = options.has_box ? Box{options.box_low_ws, options.box_high_ws} : box_of(scene.position);
  GridBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.grid = bake::probe::grid_in_box(options.grid, box.low, box.high);
  settings.seed = options.common.seed;
  settings.path.max_bounces = options.max_bounces;
  settings.path.origin_offset = bake::ray_origin_offset(scene.position);
  const bake::LitScene lit(bake::lit_triangles(std::move(scene)), read_map(options.light));

  const auto began = Clock::now();
  GridBake bake(lit, settings);
  const std::uint32_t samples = options.samples > 0 ? options.samples : default_samples;
  const std::uint32_t passes = (samples + settings.samples_per_pass - 1) / settings.samples_per_pass;
  const double error = refine(options, bake, passes);
  const std::vector<std::byte> bytes = file_of(options, bake, error);
  Json row;
  row["scene"] = options.input.stem().string();
  row["light"] = options.light.stem().string();
  row["probes"] = settings.grid.size();
  const Json made_of = describe(options.probe, settings.basis);
  for (const auto& item : made_of.items()) row[item.key()] = item.value();
  row["samples_per_probe"] = bake.samples();
  row["error"] = error;
  row["error_reached"] = error <= options.error;
  row["bytes"] = bytes.size();
  row["seconds"] = seconds_since(began);
  row["paths_per_s"] = double(bake.samples()) * double(settings.grid.size()) / seconds_since(began);
  output.commit(bytes);
  const Json rows = Json::array({row});
  if (report) report->commit(Json{{"rows", rows}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!options.common.quiet) std::fputs(table_text(rows).c_str(), stdout);
}

}  // namespace nook::cli
