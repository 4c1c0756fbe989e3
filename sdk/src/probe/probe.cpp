#include "sdk/src/probe/probe.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::probe {

std::size_t side_of(const CellWalls& cell, Vec3 in_cell) {
  std::size_t side = 0;
  for (std::size_t k = 0; k < wall_planes; ++k)
    if (dot(cell.plane[k].normal, in_cell) + cell.plane[k].offset < 0) side |= std::size_t(1) << k;
  return side;
}

WallPlane stored(const WallPlane& plane) {
  const auto half = [](float value) { return from_half(to_half(value)); };
  return {{half(plane.normal.x), half(plane.normal.y), half(plane.normal.z)}, half(plane.offset)};
}

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

// For one axis: the probes before and after a coordinate, and the weight of the second probe.
struct Between {
  std::uint32_t first, second;
  float weight;
};

Between between(float position, float origin, float spacing, std::uint32_t count) {
  const float last = float(count - 1);
  const float at = (position - origin) / spacing;
  const float clamped = at > 0 ? std::min(at, last) : 0.0f;  // NaN gives 0, too
  const auto first = std::min(std::uint32_t(clamped), count - 1);
  return {first, std::min(first + 1, count - 1), clamped - float(first)};
}

float between(float value, float least) {
  return value > least ? std::min(value, 1 - least) : least;  // NaN gives the bound `least`
}

// The maximum magnitude of a plane's components. Files and textures store planes as half floats, whose
// maximum is far larger.
constexpr float max_plane = 1024;

void check_walls(const Probes& probes, nook_result code) {
  const GridWalls& walls = probes.walls;
  if (!walls.any()) return;
  if (walls.cell.size() != probes.grid.cells())
    throw Failure(code, "the number of cells with walls is wrong (got %zu, need %zu)", walls.cell.size(),
                  probes.grid.cells());
  if (!(walls.bias >= 0 && walls.bias <= 1e9f))
    throw Failure(code, "the bias of walls is out of range (got %g metres, need 0 to 1e9)",
                  double(walls.bias));
  for (std::size_t i = 0; i < walls.cell.size(); ++i) {
    for (const WallPlane& plane : walls.cell[i].plane)
      for (const float value : {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset})
        if (!(std::abs(value) <= max_plane))
          throw Failure(code, "a wall plane of cell %zu is out of range (got %g, need at most %g)", i,
                        double(value), double(max_plane));
    for (const std::uint8_t mask : walls.cell[i].counts)
      if (mask == 0) throw Failure(code, "a side of the wall in cell %zu has no probe (need at least 1)", i);
  }
}

void check_gloss(const Probes& probes, nook_result code) {
  if (!probes.has_gloss()) return;
  if (probes.basis.kind != BasisKind::gaussians || probes.gloss.size() != probes.coefficients.size())
    throw Failure(code,
                  "the number of gloss amplitudes is wrong (got %zu, need %zu for a basis of lobes, or 0)",
                  probes.gloss.size(), probes.coefficients.size());
  for (std::size_t i = 0; i < probes.gloss.size(); ++i)
    for (const float channel : {probes.gloss[i].x, probes.gloss[i].y, probes.gloss[i].z})
      if (!(channel >= 0 && channel <= max_coefficient))
        throw Failure(code, "gloss amplitude %zu of probe %zu is out of range (got %g, need 0 to %g)",
                      i % probes.basis.count, i / probes.basis.count, double(channel),
                      double(max_coefficient));
}

}  // namespace

GridPlace place_in(const Grid& grid, Vec3 position_ws) {
  const auto cells = grid.cell_counts();
  const float at[3] = {(position_ws.x - grid.origin_ws.x) / grid.spacing_ws.x,
                       (position_ws.y - grid.origin_ws.y) / grid.spacing_ws.y,
                       (position_ws.z - grid.origin_ws.z) / grid.spacing_ws.z};
  std::array<std::uint32_t, 3> low;
  for (std::size_t k = 0; k < 3; ++k) {
    const float last = float(cells[k] - 1);
    low[k] = at[k] > 0 ? std::uint32_t(std::min(at[k], last)) : 0;  // NaN gives 0, too
  }
  GridPlace place;
  place.cell = (std::size_t(low[2]) * cells[1] + low[1]) * cells[0] + low[0];
  place.in_cell = {at[0] - float(low[0]), at[1] - float(low[1]), at[2] - float(low[2])};
  for (std::uint32_t c = 0; c < 8; ++c) {
    const std::uint32_t x = std::min(low[0] + (c & 1), grid.counts[0] - 1),
                        y = std::min(low[1] + (c >> 1 & 1), grid.counts[1] - 1),
                        z = std::min(low[2] + (c >> 2), grid.counts[2] - 1);
    place.corner[c] = (std::size_t(z) * grid.counts[1] + y) * grid.counts[0] + x;
  }
  return place;
}

std::array<float, 8> corner_weights(Vec3 in_cell, float least) {
  const float x = between(in_cell.x, least), y = between(in_cell.y, least), z = between(in_cell.z, least);
  std::array<float, 8> weight;
  for (std::size_t c = 0; c < 8; ++c)
    weight[c] = (c & 1 ? x : 1 - x) * (c & 2 ? y : 1 - y) * (c & 4 ? z : 1 - z);
  return weight;
}

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
  check_gloss(probes, code);
  check_walls(probes, code);
}

namespace {

// Interpolates between the rows of the probes. Each row has `out.size()` values.
void interpolate_rows(const Grid& grid, std::span<const Vec3> rows, Vec3 position_ws, std::span<Vec3> out) {
  const Between x = between(position_ws.x, grid.origin_ws.x, grid.spacing_ws.x, grid.counts[0]);
  const Between y = between(position_ws.y, grid.origin_ws.y, grid.spacing_ws.y, grid.counts[1]);
  const Between z = between(position_ws.z, grid.origin_ws.z, grid.spacing_ws.z, grid.counts[2]);
  std::fill(out.begin(), out.end(), Vec3{});
  for (int corner = 0; corner < 8; ++corner) {
    const bool bx = corner & 1, by = corner & 2, bz = corner & 4;
    const float weight =
        (bx ? x.weight : 1 - x.weight) * (by ? y.weight : 1 - y.weight) * (bz ? z.weight : 1 - z.weight);
    if (weight == 0) continue;
    const std::size_t row = std::size_t(bz ? z.second : z.first) * grid.counts[1] + (by ? y.second : y.first);
    const std::size_t probe = row * grid.counts[0] + (bx ? x.second : x.first);
    const std::span<const Vec3> from = rows.subspan(probe * out.size(), out.size());
    for (std::size_t i = 0; i < from.size(); ++i) out[i] += from[i] * weight;
  }
}

}  // namespace

void interpolate(const Probes& probes, Vec3 position_ws, std::span<Vec3> coefficients) {
  interpolate_rows(probes.grid, probes.coefficients, position_ws, coefficients);
}

void interpolate_gloss(const Probes& probes, Vec3 position_ws, std::span<Vec3> amplitudes) {
  interpolate_rows(probes.grid, probes.gloss, position_ws, amplitudes);
}

void interpolate(const Probes& probes, Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients) {
  if (!probes.walls.any()) return interpolate(probes, position_ws, coefficients);
  const Vec3 moved = position_ws + normal * probes.walls.bias;
  const GridPlace place = place_in(probes.grid, moved);
  const CellWalls& walls = probes.walls.cell[place.cell];
  const std::uint8_t counts = walls.counts[side_of(walls, place.in_cell)];
  if (counts == CellWalls::all_corners) return interpolate(probes, moved, coefficients);
  const std::array<float, 8> weight = corner_weights(place.in_cell, float(NOOK_GRID_LEAST_SHARE));
  std::fill(coefficients.begin(), coefficients.end(), Vec3{});
  float sum = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if (!(counts >> c & 1)) continue;
    sum += weight[c];
    const std::span<const Vec3> from = probes.of(place.corner[c]);
    for (std::size_t i = 0; i < from.size(); ++i) coefficients[i] += from[i] * weight[c];
  }
  for (Vec3& v : coefficients) v = v * (1 / sum);
}

void to_lobes(const Basis& basis, std::span<const Vec3> coefficients, std::span<SphericalGaussian> lobes) {
  for (std::size_t i = 0; i < basis.count; ++i)
    lobes[i] = {basis.axis[i], basis.sharpness[i], coefficients[i]};
}

}  // namespace nook::probe
