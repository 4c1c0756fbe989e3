// Light that a shape reflects onto itself, as irradiance at vertices for each band of distant light.
#pragma once

#include <functional>
#include <vector>

#include "bakers/transfer/surface_holes.h"
#include "sdk/src/transfer/light_bands.h"
#include "sdk/src/transfer/light_cube.h"

namespace nook::bake::transfer {

using IrradianceBands = std::array<float, nook::transfer::band_count>;

struct Reflection {
  const SurfaceMesh& mesh;
  const RayScene& scene;
  float origin_offset = 0;                 // metres along the normal
  const nook::transfer::CubeCells& cells;  // the directions that are gathered
  const SurfaceHoles* holes = nullptr;     // null: none
};

// Returns the irradiance of a vertex that comes from surfaces which receive `before` at their vertices and
// reflect all of it evenly. Only the side of a surface that its normals show reflects. The caller has set
// FlushDenormals.
IrradianceBands reflected_irradiance(const Reflection& reflection, std::size_t vertex,
                                     std::span<const IrradianceBands> before);

}  // namespace nook::bake::transfer
