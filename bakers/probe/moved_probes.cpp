#include "bakers/probe/moved_probes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bakers/probe/inside_probes.h"
#include "sdk/src/probe/axes.h"

namespace nook::bake::probe {
namespace {

constexpr float clearance_share = 0.1f;  // of the shortest spacing
constexpr int steps = 4;                 // to each side along each axis
constexpr float reach = 0.45f;           // spacings, of the last step

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
