// The bake of radiance transfer in the paper's form. See sdk/src/transfer/paper.h.
#pragma once

#include "bakers/transfer/bake.h"

namespace nook::bake::transfer {

struct PaperSettings {
  // 0: one for each 360 vertices, the density of the paper's Table II, up to 256.
  std::uint32_t clusters = 0;
  std::uint32_t lobe_rank = 64, vertex_rank = 12;  // the paper's
  // All matrices are reduced to this number of combinations of lobes first, which keeps the memory of the fit
  // at vertices x this x 3 light modes floats, four times.
  std::uint32_t common_rank = 128;
  std::uint32_t iterations = 12;
  std::uint32_t nearest = 8;  // clusters that a vertex tries
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) for numbers out of range.
void check_paper_bake(const SurfaceMesh& mesh, const PaperSettings& paper);

// The bounces and holes of `settings` count as in bake_transfer, and so does the progress, which begins with
// the matrices of vertices; `fitted` counts clusters over all iterations. Returns the same bits for the same
// seed on any number of threads. Throws Failure: as check_bake and check_paper_bake, and CANCELLED.
nook::transfer::Transfer bake_paper(const SurfaceMesh& mesh, const BakeSettings& settings,
                                    const PaperSettings& paper, const nook::material::MaterialTables& tables,
                                    const Progress& progress = {}, const Progress& fitted = {});

}  // namespace nook::bake::transfer
