#include "bakers/probe/training_places.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/probe/inside_probes.h"
#include "bakers/raytrace/random.h"

namespace nook::bake::probe {
namespace {

using nook::probe::Grid;

constexpr std::uint32_t rays_for_each_open_place = 4;
constexpr int most_draws = 16;  // attempts per origin to find a point outside solids

struct Box {
  Vec3 low, high;
  bool holds(Vec3 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
};

// The outermost cells extend half a spacing beyond their probes.
struct Range {
  float low, high;
};
Range range_of(std::uint32_t cell, std::uint32_t cells, std::uint32_t count) {
  return {cell == 0 ? -0.5f : float(cell), cell + 1 == cells ? float(count) - 0.5f : float(cell + 1)};
}

Box box_of(const Grid& grid, std::size_t cell) {
  const auto cells = grid.cell_counts();
  const std::uint32_t x = std::uint32_t(cell % cells[0]), y = std::uint32_t(cell / cells[0] % cells[1]),
                      z = std::uint32_t(cell / cells[0] / cells[1]);
  const Range a = range_of(x, cells[0], grid.counts[0]), b = range_of(y, cells[1], grid.counts[1]),
              c = range_of(z, cells[2], grid.counts[2]);
  return {grid.origin_ws + by_channel(Vec3{a.low, b.low, c.low}, grid.spacing_ws),
          grid.origin_ws + by_channel(Vec3{a.high, b.high, c.high}, grid.spacing_ws)};
}

Box box_of(const Grid& grid) {
  return {box_of(grid, 0).low, box_of(grid, grid.cells() - 1).high};
}

Vec3 uniform_direction(Random& random) {
  const float y = 1 - 2 * random.unit(), angle = 2 * std::numbers::pi_v<float> * random.unit();
  const float radius = std::sqrt(std::max(1 - y * y, 0.0f));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

bool draw_origin(const LitScene& scene, const Box& cell, Random& random, Vec3& origin) {
  for (int draw = 0; draw < most_draws; ++draw) {
    const float x = random.unit(), y = random.unit(), z = random.unit();
    origin = cell.low + by_channel(Vec3{x, y, z}, cell.high - cell.low);
    if (!is_inside(scene, origin)) return true;
  }
  return false;
}

void add(TrainingPlaces& places, Vec3 position, Vec3 normal, bool on_surface) {
  places.position_ws.push_back(position);
  places.normal.push_back(normal);
  places.on_surface.push_back(on_surface);
}

TrainingPlaces places_of_cell(const LitScene& scene, const Grid& grid, std::size_t cell,
                              const TrainingSettings& settings) {
  const FlushDenormals flush;
  const Box own = box_of(grid, cell), all = box_of(grid);
  Random random(mix_bits(settings.seed) + mix_bits(cell));
  TrainingPlaces places;
  for (std::uint32_t o = 0; o < settings.origins; ++o) {
    Vec3 origin;
    if (!draw_origin(scene, own, random, origin)) continue;
    for (std::uint32_t r = 0; r < settings.rays; ++r) {
      const Vec3 direction = uniform_direction(random), facing = uniform_direction(random);
      const float share = random.unit();
      const RayHit hit = scene.nearest(origin, direction);
      if (std::isfinite(hit.distance) && all.holds(origin + direction * hit.distance))
        add(places, origin + direction * hit.distance, hit.normal, true);
      const float far = std::min(hit.distance, length(own.high - own.low));
      const Vec3 open = origin + direction * (share * far);
      if (r % rays_for_each_open_place == 0 && all.holds(open)) add(places, open, facing, false);
    }
  }
  return places;
}

}  // namespace

TrainingPlaces training_places(const LitScene& scene, const Grid& grid, const TrainingSettings& settings,
                               const Progress& progress) {
  std::vector<TrainingPlaces> of_cell(grid.cells());
  tbb::parallel_for(std::size_t(0), of_cell.size(),
                    [&](std::size_t cell) { of_cell[cell] = places_of_cell(scene, grid, cell, settings); });
  TrainingPlaces places;
  for (const TrainingPlaces& part : of_cell)
    for (std::size_t i = 0; i < part.size(); ++i)
      add(places, part.position_ws[i], part.normal[i], part.on_surface[i] != 0);
  places.irradiance =
      trace_irradiance(scene, {places.position_ws, places.normal},
                       {settings.paths, mix_bits(settings.seed + 2), settings.path}, progress);
  return places;
}

}  // namespace nook::bake::probe
