// `nook bake probe SCENE --grid AxBxC --light MAP` bakes a grid of probes by path tracing, until its error is
// small.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/import/content_hash.h"
#include "bakers/job/probe_bake.h"
#include "bakers/measure/probe/probe_report.h"
#include "bakers/tool/bake_probe.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;
using bake::probe::GridBake;
using bake::probe::GridBakeSettings;

// Returns the probes of a finished bake, with walls if the options ask for them.
probe::Probes complete(const BakeProbeOptions& options, const bake::LitScene& scene,
                       const bake::PathSettings& path, GridBake& grid) {
  probe::Probes probes = grid.probes();
  if (!options.walls) return probes;
  bake::probe::TrainingSettings training;
  training.paths = options.training_paths;
  training.seed = options.common.seed;
  training.path = path;
  platform::ProgressBar bar(options.common.quiet);
  bake::add_walls(probes, scene, training, [&](std::size_t done, std::size_t total) {
    bar.show("light on surfaces", "places", done, total);
    return !interrupted();
  });
  return probes;
}

std::vector<std::byte> file_of(const BakeProbeOptions& options, const GridBake& grid, probe::Probes probes,
                               double error, const bake::BakeIdentity& identity) {
  Json recipe = describe(options.probe, probes.basis);
  recipe["source"] = options.input.filename().string();
  recipe["light"] = options.light.filename().string();
  recipe["direct"] = options.direct;
  recipe["walls"] = options.walls;
  recipe["samples"] = grid.samples();
  recipe["error"] = error;
  recipe["seed"] = options.common.seed;
  bake::store_identity(recipe, identity);
  probes.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace);
  return probe::write_probes(probes, packing_of(options.probe));
}

// Runs passes until the error is small enough, all samples are used, or the user stops the bake.
double refine(const BakeProbeOptions& options, GridBake& grid, std::uint32_t max_passes) {
  platform::ProgressBar bar(options.common.quiet);
  bake::GridRefinement refinement;
  refinement.max_passes = max_passes;
  refinement.error = options.error;
  refinement.preview_every_s = options.preview_every_s;
  refinement.progress = [&](std::size_t done, std::size_t total) {
    bar.show("path tracing", "passes at most", done, total);
    return !interrupted();
  };
  refinement.preview = [&](double error) {
    // A preview is not the final result, so its file does not get an identity.
    platform::OutputFile(options.baking.output).commit(file_of(options, grid, grid.probes(), error, {}));
    char label[64];
    std::snprintf(label, sizeof label, "preview written, error %.3g", error);
    bar.show(label, "passes at most", grid.passes(), max_passes);
  };
  return bake::refine_grid(grid, refinement);
}

constexpr std::uint32_t default_samples = 65536;

std::uint32_t samples_of(const BakeProbeOptions& options) {
  return options.samples > 0 ? options.samples : default_samples;
}

BakeOutput bake(const BakeProbeOptions& options, const bake::ProbeScene& scene,
                const GridBakeSettings& settings, const bake::BakeIdentity& identity) {
  const platform::Stopwatch watch;
  GridBake bake(*scene.lit, settings);
  const std::uint32_t passes =
      (samples_of(options) + settings.samples_per_pass - 1) / settings.samples_per_pass;
  const double error = refine(options, bake, passes);
  std::vector<std::byte> bytes =
      file_of(options, bake, complete(options, *scene.lit, settings.path, bake), error, identity);
  Json row;
  row["scene"] = options.input.stem().string();
  row["light"] = options.light.stem().string();
  row["probes"] = settings.grid.size();
  row["probes_inside"] = bake.inside_count();
  const Json made_of = describe(options.probe, settings.basis);
  for (const auto& item : made_of.items()) row[item.key()] = item.value();
  row["direct"] = options.direct;
  if (settings.path.direct != bake::DirectLight::all)
    row["suns"] = measure::sun_rows(scene.lit->environment());
  row["samples_per_probe"] = bake.samples();
  row["error"] = error;
  row["error_reached"] = error <= options.error;
  row["bytes"] = bytes.size();
  row["seconds"] = watch.seconds();
  row["paths_per_s"] =
      double(bake.samples()) * double(settings.grid.size() - bake.inside_count()) / watch.seconds();
  return one_row({std::move(bytes), row.dump(-1, ' ', false, Json::error_handler_t::replace)});
}

bake::BakeIdentity identity_of(const BakeProbeOptions& options, const GridBakeSettings& settings,
                               const std::string& scene_hash, const std::string& light_hash) {
  const BoxArgument& box = options.box;
  nlohmann::json asked = {{"probe", settings_of(options.probe)},
                          {"grid", options.grid},
                          {"samples", samples_of(options)},
                          {"samples_per_pass", settings.samples_per_pass},
                          {"error", options.error},
                          {"max_bounces", options.max_bounces},
                          {"direct", options.direct},
                          {"seed", options.common.seed}};
  if (box.given)
    asked["box"] = {box.low_ws.x, box.low_ws.y, box.low_ws.z, box.high_ws.x, box.high_ws.y, box.high_ws.z};
  if (options.walls) asked["walls"] = {{"training_paths", options.training_paths}};
  return bake::identify_bake(bake::BakeKind::probe_grid, asked,
                             {{"scene", scene_hash}, {"light", light_hash}});
}

}  // namespace

PreparedBake prepare_probe_grid(const BakeProbeOptions& options) {
  if (options.preview_every_s > 0 && !options.baking.prints_key &&
      !platform::OutputFile(options.baking.output).is_regular())
    throw ToolError(
        exit_bad_arguments,
        "--preview-every: -o is a device or a pipe, where a preview cannot be replaced later (got " +
            options.baking.output.string() + "); give a file");
  // To hash the scene, its files are read again, because decoded textures no longer contain the bytes of
  // their files.
  const std::string scene_hash = naming_file(options.input, [&] {
    return bake::content_hash(bake::import_static_scene(
        options.input, options.no_textures ? bake::SceneTextures::skip : bake::SceneTextures::read,
        options.reading));
  });
  // A shared pointer is needed because std::function must be copyable, and the scene is not.
  const auto scene = std::make_shared<const bake::ProbeScene>(
      read_probe_scene(options.input, options.light, !options.no_textures, options.reading, options.common));
  const std::string light_hash = bake::content_hash(scene->lit->environment());
  GridBakeSettings settings;
  settings.basis = basis_of(options.probe);
  settings.fit = fit_of(options.probe);
  settings.grid =
      bake::probe::grid_in_box(options.grid, options.box.given ? options.box.low_ws : scene->low_ws,
                               options.box.given ? options.box.high_ws : scene->high_ws);
  settings.move_probes = options.walls;
  settings.seed = options.common.seed;
  settings.path.max_bounces = options.max_bounces;
  settings.path.origin_offset = scene->origin_offset;
  settings.path.direct = bake::direct_of(options.direct);
  const bake::BakeIdentity identity = identity_of(options, settings, scene_hash, light_hash);
  return {identity, [&options, scene, settings = std::move(settings), identity] {
            return bake(options, *scene, settings, identity);
          }};
}

}  // namespace nook::tool
