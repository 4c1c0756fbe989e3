#include "sdk/src/probe/probe.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"

namespace nook::probe {

void check_grid(const Grid& grid, nook_result code) {
  std::uint64_t probes = 1;
  for (const std::uint32_t count : grid.counts) probes = count > max_probes ? 0 : probes * count;
  if (probes < 1 || probes > max_probes)
    throw Failure(code, "the grid's counts are out of range (got %u x %u x %u, need 1 to %u probes in all)",
                  grid.counts[0], grid.counts[1], grid.counts[2], max_probes);
  const float values[6] = {grid.origin_ws.x,  grid.origin_ws.y,  grid.origin_ws.z,
                           grid.spacing_ws.x, grid.spacing_ws.y, grid.spacing_ws.z};
  for (int i = 0; i < 6; ++i)
    if (!(std::abs(values[i]) <= 1e9f) || (i >= 3 && !(values[i] >= 1e-6f)))
      throw Failure(code, "the grid's %s is out of range (got %g metres, need %s to 1e9)",
                    i < 3 ? "origin" : "spacing", double(values[i]), i < 3 ? "-1e9" : "1e-6");
}

namespace {

// The two probes along one axis that a coordinate lies between, and the weight of the second.
struct Between {
  std::uint32_t first, second;
  float weight;
};

Between between(float position, float origin, float spacing, std::uint32_t count) {
  const float last = float(count - 1);
  const float at = (position - origin) / spacing;
  const float clamped = at > 0 ? std::min(at, last) : 0.0f;  // 0 also for NaN
  const auto first = std::min(std::uint32_t(clamped), count - 1);
  return {first, std::min(first + 1, count - 1), clamped - float(first)};
}

}  // namespace

void check_probes(const Probes& probes, nook_result code) {
  check_basis(probes.basis, code);
  check_grid(probes.grid, code);
  const std::size_t need = probes.grid.size() * probes.basis.count;
  if (probes.coefficients.size() != need)
    throw Failure(code, "the number of coefficients is wrong (got %zu, need %zu)", probes.coefficients.size(),
                  need);
  for (std::size_t i = 0; i < need; ++i)
    for (const float channel : {probes.coefficients[i].x, probes.coefficients[i].y, probes.coefficients[i].z})
      if (!(std::abs(channel) <= max_coefficient))
        throw Failure(code, "coefficient %zu of probe %zu is out of range (got %g, need at most %g)",
                      i % probes.basis.count, i / probes.basis.count, double(channel),
                      double(max_coefficient));
}

void interpolate(const Probes& probes, Vec3 position_ws, std::span<Vec3> coefficients) {
  const Grid& grid = probes.grid;
  const Between x = between(position_ws.x, grid.origin_ws.x, grid.spacing_ws.x, grid.counts[0]);
  const Between y = between(position_ws.y, grid.origin_ws.y, grid.spacing_ws.y, grid.counts[1]);
  const Between z = between(position_ws.z, grid.origin_ws.z, grid.spacing_ws.z, grid.counts[2]);
  std::fill(coefficients.begin(), coefficients.end(), Vec3{});
  for (int corner = 0; corner < 8; ++corner) {
    const bool bx = corner & 1, by = corner & 2, bz = corner & 4;
    const float weight =
        (bx ? x.weight : 1 - x.weight) * (by ? y.weight : 1 - y.weight) * (bz ? z.weight : 1 - z.weight);
    if (weight == 0) continue;
    const std::size_t row = std::size_t(bz ? z.second : z.first) * grid.counts[1] + (by ? y.second : y.first);
    const std::span<const Vec3> from = probes.of(row * grid.counts[0] + (bx ? x.second : x.first));
    for (std::size_t i = 0; i < from.size(); ++i) coefficients[i] += from[i] * weight;
  }
}

void to_lobes(const Basis& basis, std::span<const Vec3> coefficients, std::span<SphericalGaussian> lobes) {
  for (std::size_t i = 0; i < basis.count; ++i)
    lobes[i] = {basis.axis[i], basis.sharpness[i], coefficients[i]};
}

}  // namespace nook::probe
