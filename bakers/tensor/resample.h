// New sub-tensors of the clustered mode in the clusters that a fit has found (the paper's 6.3.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

// The steps of a map of sub-tensors, where neighbouring cells mix different clusters, and how to lower them.

using WideMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// side x side cells, row by row, each a mix of `count` clusters.
struct MixedCells {
  std::size_t side = 0, count = 0;
  std::vector<std::uint32_t> clusters;  // cells x count
  WideMatrix weights;                   // cells x (count R_m), in the order of clusters
};

// Called before each round; returns false to stop with Failure(NOOK_ERROR_CANCELLED).
using RoundProgress = std::function<bool(std::size_t round, std::size_t most_rounds)>;

// Between the centres of cells that mix the same clusters decoding is linear; at the border of two cells that
// do not, each goes on from the cell behind it, if that mixes the same clusters, and the difference is a
// step. Minimises the sum of the cells' squared errors and penalty times that of the squared steps, by
// conjugate gradients from the given weights. products: the inner products of the cells with all atoms, cells
// x (C R_m). The clusters stay. The same bits on any number of threads.
void lower_steps(const AtomGram& atoms, const WideMatrix& products, double penalty, MixedCells& cells,
                 const RoundProgress& progress = {});

// The inner products of A's mode-m sub-tensors with the atoms Z_c x_{n != m} U_{n,c}, one for each mode-m
// slice of each core, made orthonormal within a cluster: I_m x (C R_m). All that the search for clusters and
// the optimal projection read of A.
Matrix atom_projections(const ClusteredFit& fit, const TensorView& a);

// Clusters and coefficients of new sub-tensors, each a weighted sum of A's: weights is J x I_m. Neither they
// nor their number need fit in memory, for inner products mix as sub-tensors do. With weights that
// interpolate between directions this resamples the mode, and coefficients are then sought for each direction
// by greedy search and optimal projection. The coefficients belong to the fit's own cores and bases.
Mixture resample(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                 Pursuit pursuit = Pursuit::greedy);

// The same for the cells of a map, weights row by row, side x side of them, with lower steps between cells
// that mix different clusters; see lower_steps(), which reports the rounds.
Mixture resample_map(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                     std::size_t side, double step_penalty, Pursuit pursuit,
                     const RoundProgress& progress = {});

}  // namespace nook::bake::tensor
