// nook bake probe MAP: one probe of an environment map.
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
#include "probe/fit_error.h"
#include "probe/map_bake.h"
#include "probe/map_picture.h"
#include "probe/probe_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;
using bake::probe::MapBakeSettings;
using bake::probe::Sampling;

Sampling sampling_of(const std::string& name) {
  return name == "texels"      ? Sampling::texels
         : name == "luminance" ? Sampling::luminance
         : name == "uniform"   ? Sampling::uniform
                               : Sampling::automatic;
}

Json row_of(const BakeProbeOptions& options, const bake::Environment& map, const probe::Probes& probes,
            std::size_t bytes, double seconds) {
  const bake::probe::ExactFit exact(map, probes.basis);
  const bake::probe::IrradianceTruth truth(map, bake::probe::region_of(probes.basis));
  const auto irradiance = truth.error(probes.basis, probes.of(0));
  Json row;
  row["map"] = options.input.stem().string();
  const Json made_of = describe(options.probe, probes.basis);
  for (const auto& item : made_of.items()) row[item.key()] = item.value();
  row["radiance_rms"] = exact.rms(probes.of(0));
  row["irradiance_rms"] = irradiance.rms;
  row["irradiance_relative"] = number_or_null(irradiance.rms / truth.mean());
  row["excess_mse"] = number_or_null(exact.excess(probes.of(0)));
  row["mean_ratio"] = number_or_null(exact.mean_ratio(probes.of(0)));
  row["irradiance_minimum"] = number_or_null(irradiance.minimum);
  row["bytes"] = bytes;
  row["seconds_fit"] = seconds;
  return row;
}

}  // namespace

void bake_probe_of_map(const BakeProbeOptions& options) {
  MapBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.sampling = sampling_of(options.sampling);
  if (options.samples > 0) settings.samples = options.samples;
  settings.seed = options.common.seed;
  OutputFile output(options.output);
  std::optional<OutputFile> report, picture;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  if (!options.picture.empty()) picture.emplace(options.picture);
  const bake::Environment map = read_map(options.input);

  ProgressBar bar(options.common.quiet);
  const auto began = std::chrono::steady_clock::now();
  probe::Probes probes;
  probes.basis = settings.basis;
  const bake::probe::Samples samples = bake::probe::bake_samples(map, settings);
  const std::vector<Vec3> coefficients =
      bake::probe::bake_map(settings, samples, [&](std::size_t done, std::size_t total) {
        bar.show("fitting", "samples", done, total);
        return !interrupted();
      });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
  probes.coefficients.assign(coefficients.begin(), coefficients.end());
  Json recipe = describe(options.probe, settings.basis);
  recipe["source"] = options.input.filename().string();
  recipe["sampling"] = options.sampling;
  recipe["samples"] = samples.size();
  recipe["seed"] = settings.seed;
  probes.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::vector<std::byte> bytes = probe::write_probes(probes, packing_of(options.probe));

  // What is measured and shown is what the file gives back, its packing included.
  const probe::Probes stored = probe::read_probes(bytes);
  const Json rows = Json::array({row_of(options, map, stored, bytes.size(), seconds.count())});
  if (picture) picture->commit(bake::png_bytes(bake::probe::map_picture(map, stored.basis, stored.of(0))));
  output.commit(bytes);
  if (report) report->commit(Json{{"rows", rows}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!options.common.quiet) std::fputs(table_text(rows).c_str(), stdout);
}

}  // namespace nook::cli
