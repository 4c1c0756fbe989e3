// The steps of a map of sub-tensors, where neighbouring cells mix different clusters, and how to lower them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

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

}  // namespace nook::bake::tensor
