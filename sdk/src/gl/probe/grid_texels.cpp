#include "sdk/src/gl/probe/grid_texels.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/half.h"
#include "sdk/src/probe/convert.h"
#include "sdk/src/probe/packing.h"
#include "sdk/src/probe/zonal_harmonics.h"
#include "shaders/probe/constants.h"

namespace nook::gl {
namespace {

constexpr std::size_t harmonics_count = 9;  // bands 0 to 2
using Harmonics = std::array<Vec3, harmonics_count>;

Harmonics harmonics_of(const probe::Probes& probes, std::size_t index) {
  Harmonics harmonics{};
  const std::span<const Vec3> coefficients = probes.of(index);
  if (probes.basis.kind == probe::BasisKind::harmonics) {
    std::copy_n(coefficients.begin(), std::min(coefficients.size(), harmonics.size()), harmonics.begin());
    return harmonics;
  }
  std::array<SphericalGaussian, probe::max_functions> lobes;
  probe::to_lobes(probes.basis, coefficients, lobes);
  probe::to_harmonics(std::span(lobes).first(coefficients.size()), 2, harmonics);
  return harmonics;
}

std::uint16_t half_of(float value, std::size_t probe) {
  if (!(std::abs(value) <= probe::max_half))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a coefficient of probe %zu is too large for half floats (got %g, need at most %g); scale "
                  "the light down",
                  probe, double(value), double(probe::max_half));
  return to_half(value);
}

// Writes texel `layer` of a place in the grid.
class Writer {
 public:
  Writer(Vector<std::uint16_t>& texels, const probe::Grid& grid) : texels_(texels), grid_(grid) {}
  std::uint16_t* at(std::size_t layer, std::size_t place) {
    return texels_.data() + 4 * (layer * grid_.size() + place);
  }

 private:
  Vector<std::uint16_t>& texels_;
  const probe::Grid& grid_;
};

void write_numbers(Writer& writer, std::size_t probe, std::span<const Vec3> colours) {
  std::size_t number = 0;
  for (const Vec3 colour : colours)
    for (const float channel : {colour.x, colour.y, colour.z}) {
      writer.at(number / 4, probe)[number % 4] = half_of(channel, probe);
      ++number;
    }
}

void write_walls(Writer& writer, std::size_t layer, std::size_t place, const probe::CellWalls& walls) {
  for (const probe::WallPlane& plane : walls.plane) {
    const float numbers[4] = {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset};
    std::transform(numbers, numbers + 4, writer.at(layer++, place), to_half);
  }
  for (std::size_t side = 0; side < walls.counts.size(); ++side)
    writer.at(layer + side / 4, place)[side % 4] = to_half(float(walls.counts[side]));
}

}  // namespace

std::uint32_t texels_of(GridForm form) {
  return form == GridForm::harmonics ? NOOK_GRID_HARMONICS_TEXELS : NOOK_GRID_ZONAL_TEXELS;
}

GridTexelPlan plan_grid(const probe::Probes& probes, GridForm form) {
  GridTexelPlan plan{form, texels_of(form), probes.grid.counts};
  if (probes.walls.any()) plan.layers += NOOK_GRID_WALL_TEXELS;
  plan.size[2] *= plan.layers;
  return plan;
}

Vector<std::uint16_t> grid_texels(const probe::Probes& probes, const GridTexelPlan& plan, Memory* memory) {
  if (probes.basis.kind == probe::BasisKind::dice)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the probe is of ambient dice; upload one that was fitted with NOOK_PROBE_BASIS_LOBES or "
                  "NOOK_PROBE_BASIS_SH");
  Vector<std::uint16_t> texels(memory);
  texels.resize(4 * plan.texels());
  Writer writer(texels, probes.grid);
  for (std::size_t p = 0; p < probes.grid.size(); ++p) {
    const Harmonics harmonics = harmonics_of(probes, p);
    if (plan.form == GridForm::harmonics)
      write_numbers(writer, p, harmonics);
    else
      write_numbers(writer, p, probe::to_zonal(harmonics));
  }
  if (!probes.walls.any()) return texels;
  const auto cells = probes.grid.cell_counts();
  const auto& counts = probes.grid.counts;
  for (std::size_t c = 0; c < probes.walls.cell.size(); ++c) {
    const std::size_t x = c % cells[0], y = c / cells[0] % cells[1], z = c / cells[0] / cells[1];
    write_walls(writer, texels_of(plan.form), (z * counts[1] + y) * counts[0] + x, probes.walls.cell[c]);
  }
  return texels;
}

std::array<float, 16> grid_frame(const probe::Probes& probes, const GridTexelPlan& plan) {
  const probe::Grid& grid = probes.grid;
  return {grid.origin_ws.x,        grid.origin_ws.y,
          grid.origin_ws.z,        probes.walls.any() ? probes.walls.bias : 0,
          1 / grid.spacing_ws.x,   1 / grid.spacing_ws.y,
          1 / grid.spacing_ws.z,   0,
          float(grid.counts[0]),   float(grid.counts[1]),
          float(grid.counts[2]),   0,
          1 / float(plan.size[0]), 1 / float(plan.size[1]),
          1 / float(plan.size[2]), 0};
}

}  // namespace nook::gl
