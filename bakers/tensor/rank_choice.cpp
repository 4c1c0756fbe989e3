#include "bakers/tensor/rank_choice.h"

#include <algorithm>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/tensor/gram.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple) {
  check_tensor(a);
  if (share.size() != a.order() || multiple < 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%zu shares and multiples of %zu for a tensor of order %zu",
                  share.size(), multiple, a.order());
  std::vector<std::size_t> ranks(a.order());
  for (std::size_t n = 0; n < a.order(); ++n) {
    // The loss at rank r is the sum of all eigenvalues except for the r largest; they are in ascending order.
    const Eigen::VectorXd energy = symmetric_eigenvalues(gram(a, n)).cwiseMax(0.0);
    const double allowed = share[n] * energy.sum();
    double lost = 0;
    std::size_t rank = a.dimensions[n];
    while (rank > 1 && lost + energy[energy.size() - Eigen::Index(rank)] <= allowed) {
      lost += energy[energy.size() - Eigen::Index(rank)];
      --rank;
    }
    ranks[n] = std::min(a.dimensions[n], (rank + multiple - 1) / multiple * multiple);
  }
  return ranks;
}

}  // namespace nook::bake::tensor
