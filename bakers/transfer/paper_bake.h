// Bakes radiance transfer in the paper's form. See sdk/src/transfer/paper.h.
#pragma once

#include "bakers/tensor/tensor.h"
#include "bakers/transfer/separated_bake.h"
#include "bakers/transfer/visible_directions.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/tangent_frame.h"

namespace nook::bake::transfer {

// Traces the raw data of the paper's form: for each vertex, the matrix from lobes to the light modes of a
// material.

// The scene and the material for all vertices. The referenced objects must outlive the computation of the
// matrices.
struct MatrixSource {
  const SurfaceMesh& mesh;
  const RayScene& scene;
  const nook::transfer::CubeCells& cells;
  const LobesOfDirections& lobes;
  const nook::material::MaterialTables& tables;
  const SurfaceHoles* holes = nullptr;
  float origin_offset = 0;
};

// The memory that one thread reuses.
struct MatrixWorkspace {
  std::vector<VisibleDirection> visible;
  std::vector<float> basis;
  tensor::Matrix matrix;  // lobes x 3 light modes
};

// Sets work.matrix to the integrals of visibility times lobe times light basis at a vertex. The calling
// thread must have a FlushDenormals object.
void light_matrix(const MatrixSource& source, std::uint32_t lobes, std::size_t vertex, MatrixWorkspace& work);

struct PaperSettings {
  // 0 means one cluster per 360 vertices, as in the paper's Table II, up to 256 clusters.
  std::uint32_t clusters = 0;
  std::uint32_t lobe_rank = 64, vertex_rank = 12;  // as in the paper
  // All matrices are first reduced to this number of combinations of lobes. The fit then needs memory for 4 *
  // vertices * common_rank * 3 * light modes floats.
  std::uint32_t common_rank = 128;
  std::uint32_t iterations = 12;
  std::uint32_t nearest = 8;  // clusters that a vertex tries
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) if a number is out of range.
void check_paper_bake(const SurfaceMesh& mesh, const PaperSettings& paper);

// Uses the bounces and holes of `settings` like bake_transfer. `progress` first counts the vertices that the
// common basis is found from, then counts as in bake_transfer. `fitted` counts clusters over all iterations.
// Returns the same bits for the same seed on any number of threads. Throws the same failures as check_bake
// and check_paper_bake, and CANCELLED.
nook::transfer::Transfer bake_paper(const SurfaceMesh& mesh, const BakeSettings& settings,
                                    const PaperSettings& paper, const nook::material::MaterialTables& tables,
                                    const Progress& progress = {}, const Progress& fitted = {});

}  // namespace nook::bake::transfer
