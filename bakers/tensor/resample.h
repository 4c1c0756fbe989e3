// New sub-tensors of the clustered mode in the clusters that a fit has found (the paper's 6.3.2).
#pragma once

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/map_steps.h"

namespace nook::bake::tensor {

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
// that mix different clusters; see map_steps.h, whose progress it is.
Mixture resample_map(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                     std::size_t side, double step_penalty, Pursuit pursuit,
                     const RoundProgress& progress = {});

}  // namespace nook::bake::tensor
