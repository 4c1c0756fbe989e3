#include "bakers/tool/probe/evaluate_grid.h"

#include "bakers/measure/probe/report.h"
#include "bakers/tool/input_file.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/probe/scene.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

void append_grid(const EvaluateGridOptions& options, const CommonOptions& common,
                 const bake::ProbeScene& scene, const std::filesystem::path& path, platform::ProgressBar& bar,
                 Json& rows) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string file = path.filename().string();
  const measure::PlacesProgress progress = [&](const char* places) {
    return [&bar, label = file + ", " + places](std::size_t done, std::size_t total) {
      bar.show(label, "points", done, total);
      return !interrupted();
    };
  };
  const Json measured = naming_file(path, [&] {
    return measure::grid_rows(*scene.lit, scene.soup, probe::read_probes(bytes),
                              {options.points, options.paths, options.max_bounces, scene.origin_offset,
                               common.seed, options.direct},
                              progress);
  });
  for (const Json& row : measured) {
    Json named{
        {"scene", options.scene.stem().string()}, {"light", options.light.stem().string()}, {"grid", file}};
    named.update(row);
    rows.push_back(named);
  }
}

}  // namespace

Json evaluate_grids(const EvaluateGridOptions& options, const CommonOptions& common,
                    const std::vector<std::filesystem::path>& grids) {
  const bake::ProbeScene scene =
      read_probe_scene(options.scene, options.light, !options.no_textures, options.linked);
  Json report;
  report["rows"] = Json::array();
  platform::ProgressBar bar(common.quiet);
  for (const std::filesystem::path& grid : grids)
    append_grid(options, common, scene, grid, bar, report["rows"]);
  report["seed"] = common.seed;
  return report;
}

}  // namespace nook::tool
