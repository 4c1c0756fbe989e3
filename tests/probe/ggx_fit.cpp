// Fits the polynomials of sdk/src/probe/ggx_reflection.cpp to quadrature and prints their coefficients:
//   nook_ggx_fit
// Exit code 1 where a fit is worse than what the header of the reflection states.
#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/specular.h"
#include "tests/probe/ggx_quadrature.h"

using namespace nook;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// One isotropic surface, seen from one direction in the plane of x and z.
struct View {
  double alpha, facing, openness;
  double whole;    // albedo at reflectance 1
  double fresnel;  // albedo of Schlick's (1 - cosine)^5 alone
  std::vector<test::ReflectedDirection> reflected;
};

View view_of(double alpha, double facing, int steps) {
  const double sine = std::sqrt(1 - facing * facing);
  View view{alpha, facing, facing / std::hypot(facing, alpha * sine),
            0,     0,      test::visible_reflections(alpha, alpha, sine, 0, facing, steps)};
  for (const auto& l : view.reflected) {
    view.whole += l.weight;
    view.fresnel += l.weight * l.schlick;
  }
  return view;
}

// u^i v^j for i + j <= degree, j fastest.
VectorXd monomials(int degree, double u, double v) {
  VectorXd all((degree + 1) * (degree + 2) / 2);
  int at = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) all[at++] = std::pow(u, i) * std::pow(v, j);
  return all;
}

void print(const char* name, const VectorXd& k, double error) {
  std::printf("%s, error %.4f\n ", name, error);
  for (const double value : k) std::printf(" %.6g", value);
  std::printf("\n");
}

// The coefficients with the smallest maximum error, by C. Lawson's weights: rows that are far off count ever
// more.
VectorXd fit_largest(const MatrixXd& rows, const VectorXd& target, double& largest) {
  VectorXd weight = VectorXd::Constant(target.size(), 1.0 / double(target.size())), best;
  largest = 1e9;
  for (int step = 0; step < 400; ++step) {
    const VectorXd root = weight.cwiseSqrt();
    const VectorXd k = (root.asDiagonal() * rows).colPivHouseholderQr().solve(root.cwiseProduct(target));
    const VectorXd error = (rows * k - target).cwiseAbs();
    if (error.maxCoeff() < largest) {
      largest = error.maxCoeff();
      best = k;
    }
    weight = weight.cwiseProduct(error.array().pow(0.7).matrix());
    weight /= weight.sum();
  }
  return best;
}

bool fit_albedo() {
  constexpr int count = 26 * 24;
  constexpr double low_reflectance = 0.02;  // relative errors count from here on
  MatrixXd masking(count, 15), fresnel(count, 15);
  VectorXd one = VectorXd::Ones(count), cosine(count);
  for (int i = 0; i < count; ++i) {
    const View view =
        view_of(0.004 * std::pow(250, i / 24 / 25.0), 0.02 + 0.98 * std::pow(i % 24 / 23.0, 2), 128);
    const double rho = std::sqrt(view.alpha), mean_cosine = 1 - std::pow(view.fresnel / view.whole, 0.2);
    masking.row(i) = monomials(4, view.openness, view.alpha) / view.whole;
    // The relative error of the albedo for an error of the cosine.
    const double weight =
        5 * view.fresnel / (1 - mean_cosine) / (low_reflectance * view.whole + view.fresnel) + 1e-3;
    fresnel.row(i) = monomials(4, std::sqrt(view.facing), rho) * rho * weight;
    cosine[i] = (mean_cosine - view.facing) * weight;
  }
  double masking_error = 0, fresnel_error = 0;
  const VectorXd masking_k = fit_largest(masking, one, masking_error);
  const VectorXd fresnel_k = fit_largest(fresnel, cosine, fresnel_error);
  print("albedo_k", masking_k, masking_error);
  print("fresnel_k", fresnel_k, fresnel_error);
  return masking_error < 0.015 && fresnel_error < 0.036;
}

// Lobes of light of three sharpnesses over the sphere, and what each view reflects of them.
struct LitView {
  View view;
  std::vector<float> truth;
  std::vector<float> scale;  // 1 / the brightest of the same sharpness
};

struct Residuals {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  std::vector<SphericalGaussian> lights;
  std::vector<LitView> views;
  int inputs() const { return 15; }
  int values() const { return int(lights.size() * views.size()); }

  // tilt_k, wider_k, width_k.
  int operator()(const VectorXd& k, VectorXd& residual) const {
    int at = 0;
    for (const LitView& lit : views) {
      const double facing = lit.view.facing, alpha = lit.view.alpha, rho = std::sqrt(alpha);
      const double sine = std::sqrt(1 - facing * facing);
      const double lean =
          std::max(k.head(6).dot(monomials(2, lit.view.openness, rho)), 0.0) * sine / (1 + facing);
      const double cosine = (lean * sine + facing) / std::hypot(1, lean);
      const Vec3 half = normalised({float(lean), 0, 1});
      probe::AnisotropicGaussian lobe;
      lobe.z = half * float(2 * cosine) - Vec3{float(sine), 0, float(facing)};
      lobe.x = {0, 1, 0};
      lobe.y = cross(lobe.z, lobe.x);
      const double within = std::max(k.tail(6).dot(monomials(2, facing, rho)), 0.02);
      const double across =
          std::max(within + (1 - facing) * k.segment(6, 3).dot(monomials(1, facing, rho)), 0.02);
      lobe.x_sharpness = float(1 / (4 * alpha * alpha * cosine * cosine * across));
      lobe.y_sharpness = float(1 / (4 * alpha * alpha * within));
      lobe.amplitude = 1 / gaussian_integral(2 * std::sqrt(lobe.x_sharpness * lobe.y_sharpness));
      for (std::size_t i = 0; i < lights.size(); ++i)
        residual[at++] = double((probe::product_integral(lobe, lights[i]) - lit.truth[i]) * lit.scale[i]);
    }
    return 0;
  }
};

Residuals lit_views() {
  Residuals residuals;
  std::vector<std::size_t> first{0};
  for (const auto& [sharpness, count] : {std::pair{2.0f, 24}, {6.0f, 48}, {20.0f, 96}}) {
    std::vector<Vec3> axes(static_cast<std::size_t>(count));
    probe::vogel_sphere(axes);
    for (const Vec3& axis : axes) residuals.lights.push_back({axis, sharpness, {1, 1, 1}});
    first.push_back(residuals.lights.size());
  }
  for (const double alpha : {0.03, 0.05, 0.08, 0.13, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0})
    for (const double facing : {0.02, 0.08, 0.16, 0.26, 0.38, 0.5, 0.64, 0.78, 0.9, 1.0}) {
      LitView lit{view_of(alpha, facing, 80), {}, {}};
      for (const SphericalGaussian& light : residuals.lights) {
        double sum = 0;
        for (const auto& l : lit.view.reflected)
          sum += l.weight *
                 double(gaussian_value(light.axis, light.sharpness, {float(l.x), float(l.y), float(l.z)}));
        lit.truth.push_back(float(sum / lit.view.whole));
      }
      for (std::size_t s = 0; s + 1 < first.size(); ++s) {
        const auto begin = lit.truth.begin() + std::ptrdiff_t(first[s]);
        const float brightest = *std::max_element(begin, lit.truth.begin() + std::ptrdiff_t(first[s + 1]));
        lit.scale.resize(first[s + 1], 1 / brightest);
      }
      residuals.views.push_back(std::move(lit));
    }
  return residuals;
}

bool fit_lobe() {
  Residuals residuals = lit_views();
  Eigen::NumericalDiff<Residuals> differences(residuals, 1e-7);  // lobes are evaluated in floats
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(differences);
  solver.parameters.maxfev = 4000;
  VectorXd k = VectorXd::Zero(15), residual(residuals.values());
  k[2] = 1;
  k[9] = 1;
  k[10] = -0.7;
  solver.minimize(k);
  residuals(k, residual);
  const double rms = std::sqrt(residual.squaredNorm() / double(residual.size()));
  print("tilt_k", k.head(6), rms);
  print("wider_k", k.segment(6, 3), rms);
  print("width_k", k.tail(6), rms);
  return rms < 0.045;
}

}  // namespace

int main() {
  const bool albedo = fit_albedo(), lobe = fit_lobe();
  return albedo && lobe ? 0 : 1;
}
