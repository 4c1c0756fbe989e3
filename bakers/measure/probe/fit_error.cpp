#include "bakers/measure/probe/fit_error.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sdk/src/probe/axes.h"

namespace nook::bake::probe {
namespace {

Channels as_channels(Vec3 v) {
  return {double(v.x), double(v.y), double(v.z)};
}

double luminance(const Channels& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

}  // namespace

ExactFit::ExactFit(const Environment& map, const Basis& basis)
    : basis_(basis),
      map_(integrate(map, region_of(basis))),
      gram_(nook::probe::basis_gram(basis)),
      integral_(nook::probe::basis_integrals(basis)),
      best_(basis.count) {
  const auto count = Eigen::Index(basis.count);
  const std::vector<Channels> moment = moments(map, basis);
  const Eigen::Map<const Eigen::MatrixXd> gram(gram_.data(), count, count);
  const Eigen::LDLT<Eigen::MatrixXd> solver(gram);
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::VectorXd m(count);
    for (Eigen::Index i = 0; i < count; ++i) m[i] = moment[std::size_t(i)][c];
    const Eigen::VectorXd b = solver.solve(m);
    for (Eigen::Index i = 0; i < count; ++i) best_[std::size_t(i)][c] = b[i];
    // R_LS is the minimum, so the integral of R_LS^2 equals the integral of R_LS f.
    size_ += b.dot(m);
    least_ += map_.square[c] - b.dot(m);
  }
}

std::vector<Vec3> ExactFit::coefficients() const {
  std::vector<Vec3> rounded;
  for (const Channels& b : best_) rounded.push_back({float(b[0]), float(b[1]), float(b[2])});
  return rounded;
}

double ExactFit::square_apart(std::span<const Vec3> coefficients) const {
  std::vector<Channels> apart(basis_.count);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    const Channels b = as_channels(coefficients[i]);
    for (std::size_t c = 0; c < 3; ++c) apart[i][c] = b[c] - best_[i][c];
  }
  double sum = 0;
  for (std::size_t i = 0; i < apart.size(); ++i)
    for (std::size_t k = 0; k < apart.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) sum += gram_[i * basis_.count + k] * apart[i][c] * apart[k][c];
  return sum;
}

double ExactFit::square_error(std::span<const Vec3> coefficients) const {
  return least_ + square_apart(coefficients);
}

double ExactFit::excess(std::span<const Vec3> coefficients) const {
  return square_apart(coefficients) / least_;
}

double ExactFit::distance(std::span<const Vec3> coefficients) const {
  return square_apart(coefficients) / size_;
}

double ExactFit::rms(std::span<const Vec3> coefficients) const {
  return std::sqrt(std::max(square_error(coefficients), 0.0) / (3 * nook::probe::domain_area(basis_.domain)));
}

double ExactFit::mean_ratio(std::span<const Vec3> coefficients) const {
  Channels sum{};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const Channels b = as_channels(coefficients[i]);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += integral_[i] * b[c];
  }
  return luminance(sum) / luminance(map_.radiance);
}

IrradianceTruth::IrradianceTruth(const Environment& map, const Region& region, std::uint32_t normals)
    : normal_(normals) {
  constexpr std::uint32_t most_columns = 1024;  // a texel then spans a third of a degree
  if (region.domain == Domain::sphere)
    nook::probe::vogel_sphere(normal_);
  else
    nook::probe::vogel_hemisphere(region.up, normal_);
  irradiance_ = map_irradiance(reduced(map, most_columns), region, normal_);
  for (Vec3 e : irradiance_) mean_ += luminance(as_channels(e)) / double(normals);
}

IrradianceTruth::Error IrradianceTruth::error(const Basis& basis, std::span<const Vec3> coefficients,
                                              IrradianceForm form) const {
  Error error;
  error.minimum = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < normal_.size(); ++n) {
    const Channels e = as_channels(nook::probe::irradiance(basis, coefficients, form, normal_[n]));
    const Channels truth = as_channels(irradiance_[n]);
    for (std::size_t c = 0; c < 3; ++c) {
      error.rms += (e[c] - truth[c]) * (e[c] - truth[c]) / double(3 * normal_.size());
      error.minimum = std::min(error.minimum, e[c] / mean_);
    }
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

}  // namespace nook::bake::probe
