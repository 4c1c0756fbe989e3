#include "bakers/lab/probe/lookup_report.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "bakers/lab/probe/lookups.h"
#include "bakers/measure/probe/grid_error.h"
#include "bakers/probe/grid_bake.h"
#include "bakers/probe/inside_probes.h"
#include "bakers/probe/training_places.h"
#include "bakers/probe/wall_fit.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::lab {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;
using namespace measure;
using probe::Grid;
using probe::Probes;

struct Baked {
  Probes probes;
  std::vector<Vec3> positions_ws;
  std::size_t inside = 0;
};

Baked bake_grid(const LookupScene& scene, const Grid& grid, const LookupSettings& settings, bool moved,
                const bake::Progress& progress) {
  GridBakeSettings bake_settings;
  bake_settings.basis = nook::probe::harmonic_basis(2);
  bake_settings.fit.method = nook::probe::FitMethod::moments;
  bake_settings.grid = grid;
  bake_settings.move_probes = moved;
  bake_settings.seed = settings.seed;
  bake_settings.path = settings.path;
  GridBake bake(scene.lit, bake_settings);
  const std::uint32_t passes = std::max(settings.samples / bake_settings.samples_per_pass, 1u);
  while (bake.passes() < passes) {
    if (progress && !progress(bake.passes(), passes))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while path tracing");
    bake.pass();
  }
  return {bake.probes(), bake.positions_ws(), bake.inside_count()};
}

// Places of one kind, with their reference irradiance.
struct Measured {
  Places places;
  TracedPlaces truth;
  std::vector<std::size_t> all;
  std::vector<std::vector<std::size_t>> of_room;
  std::vector<std::size_t> near_walls;  // places whose horizontal distance to a surface is less than a cell
};

bool is_near_wall(const bake::LitScene& scene, const Grid& grid, Vec3 p) {
  const Vec3 across[4] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  return std::ranges::any_of(
      across, [&](Vec3 d) { return scene.nearest(p, by_channel(d, grid.spacing_ws)).distance < 1; });
}

Measured measured(const LookupScene& scene, const Grid& grid, const LookupSettings& settings, Places places,
                  const bake::Progress& progress) {
  const bake::FlushDenormals flush;
  Measured m;
  m.truth = trace_places(scene.lit, places, settings.paths, settings.seed + 7, settings.path, progress);
  if (scene.rooms) m.of_room.resize(scene.rooms->room.size());
  for (std::size_t i = 0; i < places.normal.size(); ++i) {
    const Vec3 before = places.position_ws[i] + 1e-3f * places.normal[i];
    if (scene.rooms && scene.rooms->in_solid(before)) continue;
    m.all.push_back(i);
    if (is_near_wall(scene.lit, grid, before)) m.near_walls.push_back(i);
    for (std::size_t r = 0; r < m.of_room.size(); ++r)
      if (scene.rooms->room[r].holds(before)) m.of_room[r].push_back(i);
  }
  m.places = std::move(places);
  return m;
}

struct Form {
  std::string name;
  int fetches = 0;  // texture fetches in a shader; 0: no shader exists
  Lookup at;
  std::uint32_t functions = 9;
};

std::vector<Vec3> found_by(const Form& form, const Places& places, Vec3 spacing_ws, float offset) {
  std::vector<Vec3> found;
  std::vector<Vec3> coefficients(form.functions);
  for (std::size_t i = 0; i < places.normal.size(); ++i) {
    const Vec3 normal = places.normal[i];
    form.at(places.position_ws[i] + by_channel(normal, spacing_ws) * offset, normal, coefficients);
    const Vec3 e = form.functions == nook::probe::zonal_count
                       ? nook::probe::zonal_irradiance(coefficients, normal)
                       : nook::probe::irradiance(nook::probe::harmonic_basis(2), coefficients,
                                                 nook::probe::IrradianceForm::bands, normal);
    // Clamps negative irradiance, as the shaders do.
    found.push_back({std::max(e.x, 0.0f), std::max(e.y, 0.0f), std::max(e.z, 0.0f)});
  }
  return found;
}

// Returns the error relative to the mean of the places. If there are lit rooms, computes the error of each
// room relative to the room's mean, and returns the root mean square over the rooms.
double relative_error(const LookupScene& scene, const Measured& m, const std::vector<Vec3>& found,
                      const std::vector<std::size_t>& which) {
  if (!scene.rooms) {
    const GridError error = error_of(m.truth, found, which);
    return error.rms / error.mean;
  }
  double square = 0;
  int rooms = 0;
  for (std::size_t r = 0; r < m.of_room.size(); ++r) {
    std::vector<std::size_t> own;
    std::ranges::set_intersection(m.of_room[r], which, std::back_inserter(own));
    if (r == scene.rooms->sealed || own.empty()) continue;
    const GridError error = error_of(m.truth, found, own);
    square += error.rms * error.rms / (error.mean * error.mean);
    ++rooms;
  }
  return std::sqrt(square / rooms);
}

// Returns the irradiance that a lookup finds in the sealed room, on surfaces and in the air. It is divided by
// the irradiance on the surfaces of the bright neighbour.
double leak_of(const Rooms& rooms, const Measured& surfaces, const std::vector<Vec3>& on_surfaces,
               const Measured& open, const std::vector<Vec3>& in_open) {
  double sum = 0;
  for (const std::size_t i : surfaces.of_room[rooms.sealed]) sum += double(bake::luminance(on_surfaces[i]));
  for (const std::size_t i : open.of_room[rooms.sealed]) sum += double(bake::luminance(in_open[i]));
  double bright = 0;
  for (const std::size_t i : surfaces.of_room[rooms.neighbour])
    bright += double(bake::luminance(surfaces.truth.mean(i)));
  const auto places = surfaces.of_room[rooms.sealed].size() + open.of_room[rooms.sealed].size();
  return sum / double(places) / (bright / double(surfaces.of_room[rooms.neighbour].size()));
}

double mean_of_all_light(const LookupScene& scene, const LookupSettings& settings, const Places& places,
                         const bake::Progress& progress) {
  bake::PathSettings path = settings.path;
  path.direct = bake::DirectLight::all;
  const TracedPlaces truth = trace_places(scene.lit, places, 256, settings.seed + 9, path, progress);
  double sum = 0;
  for (std::size_t i = 0; i < places.normal.size(); ++i) {
    const Vec3 e = truth.mean(i);
    sum += double(e.x + e.y + e.z) / 3;
  }
  return sum / double(places.normal.size());
}

FloorPlan floor_plan(const LookupScene& scene, const LookupSettings& settings, const Form& trilinear,
                     const Form& walls, const bake::Progress& progress) {
  constexpr float pixels_per_metre = 12;
  constexpr std::uint32_t paths = 128;
  const Vec3 low = scene.rooms->low_ws, size = scene.rooms->high_ws - low;
  FloorPlan plan;
  plan.width = int(size.x * pixels_per_metre);
  plan.height = int(size.z * pixels_per_metre);
  Places floor;
  for (int row = 0; row < plan.height; ++row)
    for (int column = 0; column < plan.width; ++column) {
      floor.position_ws.push_back({low.x + (float(column) + 0.5f) / pixels_per_metre, 0,
                                   low.z + (float(row) + 0.5f) / pixels_per_metre});
      floor.normal.push_back({0, 1, 0});
    }
  const TracedPlaces traced =
      trace_places(scene.lit, floor, paths, settings.seed + 11, settings.path, progress);
  for (std::size_t i = 0; i < floor.normal.size(); ++i) plan.traced.push_back(traced.mean(i));
  plan.trilinear = found_by(trilinear, floor, {}, 0);
  plan.walls = found_by(walls, floor, {}, 0);
  return plan;
}

}  // namespace

Json lookup_rows(const LookupScene& scene, const Grid& grid, const LookupSettings& settings,
                 const PlacesProgress& progress, FloorPlan* plan) {
  const Baked plain = bake_grid(scene, grid, settings, false, progress("probes")),
              moved = bake_grid(scene, grid, settings, true, progress("moved probes"));
  TrainingSettings training;
  training.paths = settings.training_paths;
  training.seed = settings.seed + 1000;
  training.path = settings.path;
  const TrainingPlaces trained = training_places(scene.lit, grid, training, progress("places to fit to"));
  Probes walls = moved.probes, fitted = moved.probes, both = moved.probes;
  walls.walls = fit_walls(walls, trained);
  fit_to_surfaces(fitted, trained);
  both.walls = walls.walls;
  fit_to_surfaces(both, trained);
  const Probes zonal = zonal_in_half_floats(both), plain_zonal = zonal_in_half_floats(plain.probes);
  const Moments moments(scene.lit, moved.positions_ws, grid.spacing_ws);

  const std::vector<bool> inside = inside_probes(scene.lit, grid);
  const Measured surfaces =
                     measured(scene, grid, settings,
                              places_on_surfaces(scene.lit, scene.soup, grid, inside,
                                                 settings.path.origin_offset, settings.points, settings.seed),
                              progress("on surfaces")),
                 open = measured(scene, grid, settings,
                                 places_in_the_open(scene.lit, grid, settings.points, settings.seed),
                                 progress("in the open"));
  std::optional<double> all_light;
  if (settings.path.direct != bake::DirectLight::all)
    all_light = mean_of_all_light(scene, settings, surfaces.places, progress("all light"));

  const std::uint32_t zonal_count = std::uint32_t(nook::probe::zonal_count);
  const Form forms[] = {
      {"trilinear", 7, own_lookup(plain.probes)},
      {"trilinear, ZH3", 4, own_lookup(plain_zonal), zonal_count},
      {"a quarter of a cell off", 7, own_lookup(plain.probes, 0.25f)},
      {"moved probes", 7, own_lookup(moved.probes)},
      {"exact visibility", 0,
       visibility_lookup(plain.probes, scene.lit, plain.positions_ws, settings.path.origin_offset)},
      {"exact visibility, moved probes", 0,
       visibility_lookup(moved.probes, scene.lit, moved.positions_ws, settings.path.origin_offset)},
      {"moments, moved probes", 40, moments.lookup(moved.probes)},
      {"fitted to surfaces", 7, own_lookup(fitted)},
      {"walls", 67, own_lookup(walls)},
      {"walls, fitted to surfaces", 67, own_lookup(both)},
      {"walls, fitted to surfaces, ZH3", 40, own_lookup(zonal), zonal_count}};
  if (plan && scene.rooms)
    *plan = floor_plan(scene, settings, forms[0], *std::prev(std::end(forms)), progress("floor"));
  Json rows = Json::array();
  double trilinear = 0;
  for (const Form& form : forms) {
    const std::vector<Vec3> on_surfaces = found_by(form, surfaces.places, grid.spacing_ws, 0),
                            off = found_by(form, surfaces.places, grid.spacing_ws, 0.5f),
                            in_open = found_by(form, open.places, grid.spacing_ws, 0);
    const double error = relative_error(scene, surfaces, on_surfaces, surfaces.all);
    if (rows.empty()) trilinear = error;
    Json row{{"scene", scene.name},
             {"probes", grid.size()},
             {"form", form.name},
             {"fetches", form.fetches > 0 ? Json(form.fetches) : Json()},
             {"on_surfaces", error},
             {"over_trilinear", error / trilinear},
             {"half_cell_off", relative_error(scene, surfaces, off, surfaces.all)},
             {"in_the_open", relative_error(scene, open, in_open, open.all)},
             {"near_walls", relative_error(scene, open, in_open, open.near_walls)},
             {"near_walls_share", double(open.near_walls.size()) / double(open.all.size())}};
    const GridError whole = error_of(surfaces.truth, on_surfaces, surfaces.all);
    row["worst"] = whole.worst / whole.mean;
    row["noise"] = whole.noise / whole.mean;
    if (all_light) row["on_surfaces_of_all_light"] = whole.rms / *all_light;
    if (scene.rooms) row["leak"] = leak_of(*scene.rooms, surfaces, on_surfaces, open, in_open);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace nook::lab
