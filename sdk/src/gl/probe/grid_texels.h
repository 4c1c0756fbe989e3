// Grids of diffuse light as the half floats that shaders/probe/volume/host.glsl reads.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

enum class GridForm : std::uint8_t { harmonics = 0, zonal = 1 };
// The texels of a probe.
std::uint32_t texels_of(GridForm form);

// Layers as large as the grid, one behind the other along z: those of a probe's numbers, four a texel, then,
// if there are walls, those of a cell's planes and of its sides' masks.
struct GridTexelPlan {
  GridForm form = GridForm::harmonics;
  std::uint32_t layers = 0;
  std::array<std::uint32_t, 3> size{};  // of the texture, in texels

  std::uint64_t texels() const { return std::uint64_t(size[0]) * size[1] * size[2]; }
};
GridTexelPlan plan_grid(const probe::Probes& probes, GridForm form);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT): dice, or a coefficient that no half float holds.
Vector<std::uint16_t> grid_texels(const probe::Probes& probes, const GridTexelPlan& plan, Memory* memory);

// The uniform nook_grid_frame.
std::array<float, 16> grid_frame(const probe::Probes& probes, const GridTexelPlan& plan);

}  // namespace nook::gl
