// Computes the light that a shape reflects onto itself: the irradiance at vertices for each band of distant
// light.
#pragma once

#include <span>
#include <vector>

#include "bakers/transfer/vertex_loop.h"
#include "bakers/transfer/visible_directions.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::bake::transfer {

using IrradianceBands = std::array<float, nook::transfer::band_count>;

struct Reflection {
  const SurfaceMesh& mesh;
  const RayScene& scene;
  float origin_offset = 0;                 // metres along the normal
  const nook::transfer::CubeCells& cells;  // directions to gather from
  const SurfaceHoles* holes = nullptr;     // null: none
};

// Returns the irradiance of a vertex for each band of light, from the directions in which it sees the sky.
IrradianceBands direct_irradiance(Vec3 normal, const nook::transfer::CubeCells& cells,
                                  std::span<const VisibleDirection> visible);

// Returns the irradiance that a vertex receives from surfaces. `before` is the irradiance of the surfaces at
// their vertices. The surfaces reflect all of it diffusely, but only on the side of their normals. The
// calling thread must have a FlushDenormals object.
IrradianceBands reflected_irradiance(const Reflection& reflection, std::size_t vertex,
                                     std::span<const IrradianceBands> before);

// Computes the reflected light of the transfer, one reflection after another. `received` is the direct
// irradiance of all vertices.
void reflect(const Reflection& reflection, std::uint32_t bounces, VertexLoop& loop,
             std::vector<IrradianceBands> received, nook::transfer::Transfer& transfer);

}  // namespace nook::bake::transfer
