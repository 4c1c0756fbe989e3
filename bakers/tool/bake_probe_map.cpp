// `nook bake probe MAP` bakes one probe from an environment map.
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/images/picture.h"
#include "bakers/job/probe_bake.h"
#include "bakers/measure/probe/probe_report.h"
#include "bakers/tool/bake_probe.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_inputs.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"

namespace nook::tool {
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
  Json row;
  row["map"] = options.input.stem().string();
  row.update(describe(options.probe, probes.basis));
  row.update(measure::probe_errors(map, probes));
  row["bytes"] = bytes;
  row["seconds_fit"] = seconds;
  return row;
}

BakeOutput bake(const BakeProbeOptions& options, const bake::Environment& map,
                const MapBakeSettings& settings, const bake::BakeIdentity& identity) {
  std::optional<platform::OutputFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture, file_events(options.common.quiet));
  platform::ProgressBar bar(options.common.quiet);
  const platform::Stopwatch watch;
  bake::MapProbe baked = bake::bake_map_probe(map, settings, [&](std::size_t done, std::size_t total) {
    bar.show("fitting", "samples", done, total);
    return !interrupted();
  });
  const double seconds = watch.seconds();
  Json recipe = describe(options.probe, settings.basis);
  recipe["source"] = options.input.filename().string();
  recipe["sampling"] = options.sampling;
  recipe["samples"] = baked.samples;
  recipe["seed"] = settings.seed;
  bake::store_identity(recipe, identity);
  baked.probes.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::byte> bytes = probe::write_probes(baked.probes, packing_of(options.probe));

  // The error and the picture are computed from the packed probe as the file stores it, so they include the
  // loss from packing.
  const probe::Probes stored = probe::read_probes(bytes);
  const Json row = row_of(options, map, stored, bytes.size(), seconds);
  if (picture) picture->commit(bake::png_bytes(bake::probe::map_picture(map, stored.basis, stored.of(0))));
  return one_row({std::move(bytes), row.dump(-1, ' ', false, Json::error_handler_t::replace)});
}

}  // namespace

PreparedBake prepare_probe_of_map(const BakeProbeOptions& options) {
  MapBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.sampling = sampling_of(options.sampling);
  if (options.samples > 0) settings.samples = options.samples;
  settings.seed = options.common.seed;
  bake::Environment map = read_map(options.input);
  const bake::BakeIdentity identity = bake::identify_bake(bake::BakeKind::probe,
                                                          {{"probe", settings_of(options.probe)},
                                                           {"sampling", options.sampling},
                                                           {"samples", settings.samples},
                                                           {"seed", settings.seed}},
                                                          {{"map", bake::content_hash(map)}});
  return {identity, [&options, map = std::move(map), settings = std::move(settings), identity] {
            return bake(options, map, settings, identity);
          }};
}

}  // namespace nook::tool
