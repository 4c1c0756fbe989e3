#include "bakers/synthesis/balance.h"

#include <cmath>

namespace nook::bake::synthesis {

Exemplar balanced(const Exemplar& exemplar) {
  Exemplar out = exemplar;
  const Eigen::RowVectorXf mean = out.values.cast<double>().colwise().mean().cast<float>();
  out.values.rowwise() -= mean;
  const double before = out.values.cast<double>().squaredNorm();
  for (Eigen::Index channel = 0; channel < out.values.cols(); ++channel) {
    const double deviation =
        std::sqrt(out.values.col(channel).cast<double>().squaredNorm() / double(out.values.rows()));
    if (deviation > 0) out.values.col(channel) *= float(1 / std::sqrt(deviation));
  }
  const double after = out.values.cast<double>().squaredNorm();
  if (after > 0) out.values *= float(std::sqrt(before / after));
  return out;
}

}  // namespace nook::bake::synthesis
