// New sub-tensors of the clustered mode, in the clusters of a fit (the paper's 6.3.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

// Lowers the steps in a map of sub-tensors, where neighbouring cells mix different clusters.

using WideMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// side x side cells, row by row, each a mix of `count` clusters.
struct MixedCells {
  std::size_t side = 0, count = 0;
  std::vector<std::uint32_t> clusters;  // cells x count
  WideMatrix weights;                   // cells x (count R_m), in the order of clusters
};

// Called before each round. Return false to stop with Failure(NOOK_ERROR_CANCELLED).
using RoundProgress = std::function<bool(std::size_t round, std::size_t most_rounds)>;

// Decoding is linear between the centres of cells that mix the same clusters. At the border of two other
// cells, each extrapolates from the cell behind it, if that mixes the same clusters. The difference at the
// border is a step.
//
// Minimises the sum of the cells' squared errors plus penalty times the squared steps, by conjugate gradients
// from the given weights. The clusters stay. products: the inner products of the cells with all atoms, cells
// x (C R_m). Any number of threads gives the same bits.
void lower_steps(const AtomGram& atoms, const WideMatrix& products, double penalty, MixedCells& cells,
                 const RoundProgress& progress = {});

// Returns the inner products of A's mode-m sub-tensors with the atoms Z_c x_{n != m} U_{n,c}: I_m x (C R_m).
// There is one atom for each mode-m slice of each core, orthonormal within a cluster. The search for clusters
// and the optimal projection read nothing else of A.
Matrix atom_projections(const ClusteredFit& fit, const TensorView& a);

// Finds clusters and coefficients of new sub-tensors. Each is a weighted sum of A's, and weights is J x I_m.
// They need not fit in memory, because inner products mix like sub-tensors. Weights that interpolate between
// directions resample the mode. Greedy search and optimal projection find the coefficients for each
// direction. The coefficients belong to the fit's own cores and bases.
Mixture resample(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                 Pursuit pursuit = Pursuit::greedy);

// The same for the cells of a map, side x side, with weights row by row. It lowers the steps between cells
// that mix different clusters; see lower_steps(), which reports the rounds.
Mixture resample_map(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                     std::size_t side, double step_penalty, Pursuit pursuit,
                     const RoundProgress& progress = {});

}  // namespace nook::bake::tensor
