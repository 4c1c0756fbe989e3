#include "bakers/probe/inside_probes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sdk/src/probe/axes.h"

namespace nook::bake::probe {
namespace {

using nook::probe::Grid;

constexpr std::size_t directions = 256;

}  // namespace

bool is_inside(const LitScene& scene, Vec3 position_ws) {
  std::array<Vec3, directions> direction;
  nook::probe::vogel_sphere(direction);
  std::size_t from_behind = 0;
  for (const Vec3 d : direction) {
    const RayHit hit = scene.nearest(position_ws, d);
    from_behind += std::isfinite(hit.distance) && hit.from_behind;
  }
  return from_behind > directions / 2;
}

std::vector<bool> inside_probes(const LitScene& scene, const std::vector<Vec3>& positions_ws) {
  std::vector<char> found(positions_ws.size());
  tbb::parallel_for(std::size_t(0), positions_ws.size(), [&](std::size_t p) {
    const FlushDenormals flush;
    found[p] = is_inside(scene, positions_ws[p]);
  });
  std::vector<bool> inside(found.begin(), found.end());
  if (std::find(inside.begin(), inside.end(), false) == inside.end()) inside.assign(inside.size(), false);
  return inside;
}

std::vector<bool> inside_probes(const LitScene& scene, const Grid& grid) {
  return inside_probes(scene, grid_probes(grid));
}

namespace {

// `rows` has `count` values for each probe.
void fill_rows(const Grid& grid, std::size_t count, std::vector<bool> inside, std::span<Vec3> rows) {
  const std::size_t row = grid.counts[0], slice = row * grid.counts[1];
  const auto left = [&] { return std::find(inside.begin(), inside.end(), true) != inside.end(); };
  while (left()) {
    // Fills one layer of probes from the previous state, so that the result does not depend on the order of
    // probes.
    const std::vector<bool> before = inside;
    for (std::size_t p = 0; p < grid.size(); ++p) {
      if (!before[p]) continue;
      std::vector<Vec3> sum(count);
      float neighbours = 0;
      const auto add = [&](bool exists, std::size_t from) {
        if (!exists || before[from]) return;
        for (std::size_t i = 0; i < count; ++i) sum[i] += rows[from * count + i];
        ++neighbours;
      };
      const std::size_t x = p % row, y = p / row % grid.counts[1], z = p / slice;
      add(x > 0, p - 1);
      add(x + 1 < row, p + 1);
      add(y > 0, p - row);
      add(y + 1 < grid.counts[1], p + row);
      add(z > 0, p - slice);
      add(z + 1 < grid.counts[2], p + slice);
      if (neighbours == 0) continue;
      for (std::size_t i = 0; i < count; ++i) rows[p * count + i] = sum[i] * (1 / neighbours);
      inside[p] = false;
    }
    if (inside == before) return;  // all probes are inside
  }
}

}  // namespace

void fill_inside(nook::probe::Probes& probes, const std::vector<bool>& inside) {
  fill_rows(probes.grid, probes.basis.count, inside, probes.coefficients);
  if (probes.has_gloss()) fill_rows(probes.grid, probes.basis.count, inside, probes.gloss);
}

namespace {

constexpr float clearance_share = 0.1f;  // share of the shortest spacing
constexpr int steps = 4;                 // steps in each direction along each axis
constexpr float reach = 0.45f;           // distance of the last step, in spacings

float clearance(const LitScene& scene, Vec3 position_ws) {
  std::array<Vec3, 64> direction;
  nook::probe::vogel_sphere(direction);
  float least = std::numeric_limits<float>::infinity();
  for (const Vec3 d : direction) least = std::min(least, scene.nearest(position_ws, d).distance);
  return least;
}

Vec3 moved(const LitScene& scene, Vec3 at, Vec3 spacing) {
  const float need = clearance_share * std::min({spacing.x, spacing.y, spacing.z});
  const auto clear = [&](Vec3 p) { return clearance(scene, p) >= need && !is_inside(scene, p); };
  if (clear(at)) return at;
  float least = std::numeric_limits<float>::infinity();
  Vec3 best = at;
  for (int x = -steps; x <= steps; ++x)
    for (int y = -steps; y <= steps; ++y)
      for (int z = -steps; z <= steps; ++z) {
        const Vec3 step = by_channel(Vec3{float(x), float(y), float(z)} * (reach / steps), spacing);
        const float far = dot(step, step);
        if (far >= least || !clear(at + step)) continue;
        least = far;
        best = at + step;
      }
  return best;
}

}  // namespace

std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid) {
  std::vector<Vec3> position = grid_probes(grid);
  tbb::parallel_for(std::size_t(0), grid.size(), [&](std::size_t p) {
    const FlushDenormals flush;
    position[p] = moved(scene, position[p], grid.spacing_ws);
  });
  return position;
}

std::vector<Vec3> grid_probes(const nook::probe::Grid& grid) {
  std::vector<Vec3> position(grid.size());
  for (std::size_t p = 0; p < grid.size(); ++p) position[p] = grid.position_ws(p);
  return position;
}

}  // namespace nook::bake::probe
