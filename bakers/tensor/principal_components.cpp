#include "bakers/tensor/principal_components.h"

#include <algorithm>

#include "bakers/algebra/symmetric_eigen.h"

namespace nook::bake::tensor {

PrincipalComponents principal_components(const Matrix& samples, std::size_t count) {
  PrincipalComponents out;
  out.mean = samples.cast<double>().colwise().mean().cast<float>();
  const Matrix centred = samples.rowwise() - out.mean;
  Eigen::MatrixXf covariance = Eigen::MatrixXf::Zero(samples.cols(), samples.cols());
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(centred.transpose());
  const SymmetricEigen eigen = symmetric_eigen(covariance.cast<double>());
  const Eigen::Index kept = std::min(Eigen::Index(count), samples.cols());
  out.basis = eigen.vectors.rightCols(kept).rowwise().reverse().cast<float>();
  return out;
}

Matrix project(const Matrix& samples, const PrincipalComponents& components) {
  return (samples.rowwise() - components.mean) * components.basis;
}

}  // namespace nook::bake::tensor
