#include "cli/probe/evaluate_grid.h"

#include <algorithm>

#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/probe/scene.h"
#include "cli/progress_bar.h"
#include "cli/table.h"
#include "probe/grid_error.h"
#include "probe/inside_probes.h"
#include "probe/probe_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

Json error_row(const GridError& e) {
  return {{"irradiance_mean", e.mean},
          {"irradiance_rms", e.rms},
          {"irradiance_rms_relative", number_or_null(e.rms / e.mean)},
          {"irradiance_bias_relative", number_or_null(e.bias / e.mean)},
          {"irradiance_worst_relative", number_or_null(e.worst / e.mean)},
          {"noise_rms_relative", number_or_null(e.noise / e.mean)}};
}

// What the grid's recipe says, which files of other tools lack.
std::string direct_of_recipe(const nook::probe::Probes& probes) {
  const Json recipe = Json::parse(probes.recipe, nullptr, false);
  const auto direct = recipe.is_object() ? recipe.find("direct") : recipe.end();
  const std::string name = direct != recipe.end() && direct->is_string() ? direct->get<std::string>() : "all";
  return std::ranges::count(direct_names, name) ? name : "all";
}

void append_grid(const EvaluateGridOptions& options, const CommonOptions& common, const ProbeScene& scene,
                 const std::filesystem::path& path, ProgressBar& bar, Json& rows) {
  const std::vector<std::byte> bytes = read_file(path);
  const nook::probe::Probes probes = naming_file(path, [&] { return nook::probe::read_probes(bytes); });
  const std::vector<bool> inside = inside_probes(*scene.lit, probes.grid);
  const std::string direct = options.direct.empty() ? direct_of_recipe(probes) : options.direct;
  const bake::PathSettings trace{options.max_bounces, scene.origin_offset, direct_of(direct)};
  const Places surfaces = naming_file(path, [&] {
    return places_on_surfaces(*scene.lit, scene.soup, probes.grid, inside, scene.origin_offset,
                              options.points, common.seed);
  });
  const Places open = naming_file(
      path, [&] { return places_in_the_open(*scene.lit, probes.grid, options.points, common.seed); });
  Places off = surfaces;
  off.lookup_offset = 0.5f;
  const std::pair<const char*, const Places&> kinds[] = {
      {"on surfaces", surfaces}, {"on surfaces, looked up half a cell off", off}, {"in the open", open}};
  for (const auto& [name, places] : kinds) {
    const std::string label = path.filename().string() + ", " + name;
    const GridError error = grid_error(*scene.lit, probes, places, options.paths, common.seed, trace,
                                       [&](std::size_t done, std::size_t total) {
                                         bar.show(label, "points", done, total);
                                         return !interrupted();
                                       });
    Json row{{"scene", options.scene.stem().string()},
             {"light", options.light.stem().string()},
             {"grid", path.filename().string()},
             {"direct", direct},
             {"places", name},
             {"probes", probes.grid.size()},
             {"probes_inside", std::count(inside.begin(), inside.end(), true)},
             {"lobes", probes.basis.count},
             {"floats", 3 * probes.basis.count},
             {"points", places.normal.size()},
             {"paths", options.paths / 2 * 2}};
    row.update(error_row(error));
    rows.push_back(row);
  }
}

}  // namespace

Json evaluate_grids(const EvaluateGridOptions& options, const CommonOptions& common,
                    const std::vector<std::filesystem::path>& grids) {
  const ProbeScene scene = read_probe_scene(options.scene, options.light, !options.no_textures);
  Json report;
  report["rows"] = Json::array();
  ProgressBar bar(common.quiet);
  for (const std::filesystem::path& grid : grids)
    append_grid(options, common, scene, grid, bar, report["rows"]);
  report["seed"] = common.seed;
  return report;
}

}  // namespace nook::cli
