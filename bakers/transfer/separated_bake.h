// Bakes radiance transfer: for each vertex and lobe, the cosine-weighted share of the lobe's light that
// reaches the vertex. See sdk/src/transfer/transfer.h.
#pragma once

#include <cstdint>
#include <memory>

#include "bakers/import/surface_mesh.h"
#include "bakers/transfer/surface_holes.h"
#include "bakers/transfer/vertex_loop.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::bake::transfer {

struct BakeSettings {
  std::uint32_t lobes = 642;
  // Rays go through the centres of the cells of a cube with side x side cells per face. The paper uses 32,
  // which gives 6,144 rays per vertex. Half of them are below the vertex's horizon.
  std::uint32_t side = 32;
  // How often the shape reflects light onto itself, up to max_bounces. Reflected light is gathered through
  // the same cells.
  std::uint32_t bounces = 0;
  // The holes of the shape's material; null: no holes. There are `tiles` tiles in one unit of texture
  // coordinates.
  std::shared_ptr<const HoleTable> holes = nullptr;
  float tiles = 1;
};
inline constexpr std::uint32_t max_ray_side = 256;

// Throws Failure(INVALID_ARGUMENT) for settings or indices out of range, a mesh without vertices, arrays of
// different lengths, and numbers that are not finite. Also throws it if a normal's or tangent's length
// differs from 1 by more than 1e-3.
void check_bake(const SurfaceMesh& mesh, const BakeSettings& settings);

// `progress` counts vertices, once for the direct light and once for each reflection. Rays start above their
// vertex, 1e-4 of the bounding box's diagonal along its normal. Threads work on blocks of vertices. The
// result does not depend on the number of threads. It has passed check_transfer, and its recipe is empty.
// Throws the same failures as check_bake, and CANCELLED if progress returns false.
nook::transfer::Transfer bake_transfer(const SurfaceMesh& mesh, const BakeSettings& settings,
                                       const Progress& progress = {});

// Returns the frame of a vertex as stored in the file.
nook::transfer::Frame frame_of(const SurfaceMesh& mesh, std::size_t vertex);

// Returns the hashes of the arrays of a mesh.
nook::transfer::MeshHashes hashes_of(const SurfaceMesh& mesh);

}  // namespace nook::bake::transfer
