// Compares the polynomials of sdk/src/probe/ggx_reflection.cpp with quadrature:
//   nook_ggx_fit
// Exit code 1 where they are worse than what the header of the reflection states. Fits them anew and prints
// the lines of shaders/probe/constants.h (a minute):
//   nook_ggx_fit fit
#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <string_view>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "bakers/measure/probe/visible_reflections.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/probe_light.h"
#include "shaders/probe/constants.h"

using namespace nook;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// One surface, seen from one direction.
struct View {
  probe::Surface surface;
  double facing, openness;
  double whole = 0;    // albedo at reflectance 1
  double fresnel = 0;  // albedo of Schlick's (1 - cosine)^5 alone
  std::vector<measure::ReflectedDirection> reflected;
};

View seen(double alpha_x, double alpha_y, double facing, double azimuth, int steps) {
  const double sine = std::sqrt(1 - facing * facing), x = sine * std::cos(azimuth),
               y = sine * std::sin(azimuth);
  View view;
  view.surface.view = {float(x), float(y), float(facing)};
  view.surface.alpha_x = float(alpha_x);
  view.surface.alpha_y = float(alpha_y);
  view.facing = facing;
  view.openness = facing / std::hypot(facing, alpha_x * x, alpha_y * y);
  view.reflected = measure::visible_reflections(alpha_x, alpha_y, x, y, facing, steps);
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

void print(const char* name, const VectorXd& k) {
  // Five or six numbers fit a line.
  const Eigen::Index line = k.size() == 6 ? 6 : 5;
  for (Eigen::Index i = 0; i < k.size(); ++i) {
    if (i % line > 0)
      std::printf(", %.6g", k[i]);
    else if (k.size() == line)
      std::printf("#define NOOK_GGX_%s %.6g", name, k[i]);
    else
      std::printf("%s#define NOOK_GGX_%s_%d %.6g", i ? "\n" : "", name, int(i / line), k[i]);
  }
  std::printf("\n");
}

template <std::size_t count>
VectorXd present(const double (&k)[count]) {
  return Eigen::Map<const VectorXd>(k, Eigen::Index(count));
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

// Rows of equations for the albedo over views: whole albedos relative to the truth, and the cosine whose
// Fresnel term equals the mean over all normals, weighed by the relative error of the albedo for an error of
// it.
struct AlbedoRows {
  MatrixXd whole, fresnel;
  VectorXd one, cosine;
};

AlbedoRows albedo_rows() {
  constexpr int count = 26 * 24;
  constexpr double low_reflectance = 0.02;  // relative errors count from here on
  AlbedoRows rows{MatrixXd(count, 15), MatrixXd(count, 15), VectorXd::Ones(count), VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    const double alpha = 0.004 * std::pow(250, i / 24 / 25.0);
    const View view = seen(alpha, alpha, 0.02 + 0.98 * std::pow(i % 24 / 23.0, 2), 0, 128);
    const double rho = std::sqrt(alpha), mean_cosine = 1 - std::pow(view.fresnel / view.whole, 0.2);
    rows.whole.row(i) = monomials(4, view.openness, alpha) / view.whole;
    const double weight =
        5 * view.fresnel / (1 - mean_cosine) / (low_reflectance * view.whole + view.fresnel) + 1e-3;
    rows.fresnel.row(i) = monomials(4, std::sqrt(view.facing), rho) * rho * weight;
    rows.cosine[i] = (mean_cosine - view.facing) * weight;
  }
  return rows;
}

bool albedo(bool fit) {
  const AlbedoRows rows = albedo_rows();
  double whole_error = 0, fresnel_error = 0;
  if (fit) {
    print("ALBEDO", fit_largest(rows.whole, rows.one, whole_error));
    print("FRESNEL", fit_largest(rows.fresnel, rows.cosine, fresnel_error));
  } else {
    const double whole_k[] = {NOOK_GGX_ALBEDO_0, NOOK_GGX_ALBEDO_1, NOOK_GGX_ALBEDO_2},
                 fresnel_k[] = {NOOK_GGX_FRESNEL_0, NOOK_GGX_FRESNEL_1, NOOK_GGX_FRESNEL_2};
    whole_error = (rows.whole * present(whole_k) - rows.one).cwiseAbs().maxCoeff();
    fresnel_error = (rows.fresnel * present(fresnel_k) - rows.cosine).cwiseAbs().maxCoeff();
  }
  std::printf("albedo: largest error %.4f, of Fresnel %.4f\n", whole_error, fresnel_error);
  return whole_error < 0.015 && fresnel_error < 0.036;
}

// A view, and what it reflects of lobes of light of three sharpnesses over the sphere.
struct LitView {
  View view;
  std::vector<float> truth;
};

std::vector<SphericalGaussian> lights() {
  std::vector<SphericalGaussian> all;
  for (const auto& [sharpness, count] : {std::pair{2.0f, 16}, {6.0f, 40}, {20.0f, 60}}) {
    std::vector<Vec3> axes(static_cast<std::size_t>(count));
    probe::vogel_sphere(axes);
    for (const Vec3& axis : axes) all.push_back({axis, sharpness, {1, 1, 1}});
  }
  return all;
}

LitView lit(View view, const std::vector<SphericalGaussian>& lights) {
  std::vector<float> truth;
  for (const SphericalGaussian& light : lights) {
    double sum = 0;
    for (const auto& l : view.reflected)
      sum += l.weight *
             double(gaussian_value(light.axis, light.sharpness, {float(l.x), float(l.y), float(l.z)}));
    truth.push_back(float(sum / view.whole));
  }
  view.reflected.clear();
  return {std::move(view), std::move(truth)};
}

std::vector<LitView> lit_views(bool two_widths) {
  const std::vector<SphericalGaussian> all = lights();
  std::vector<LitView> views;
  for (const double facing : {0.03, 0.07, 0.14, 0.24, 0.38, 0.52, 0.66, 0.8, 0.94, 1.0}) {
    for (const double roughness : {0.14, 0.25, 0.36, 0.46, 0.57, 0.68, 0.78, 0.88, 0.98})
      views.push_back(lit(seen(roughness * roughness, roughness * roughness, facing, 0, 64), all));
    if (!two_widths) continue;
    for (const auto& [x, y] : {std::pair{0.1, 0.3}, {0.4, 0.1}, {0.2, 0.8}, {0.05, 0.2}, {0.5, 1.0}})
      for (const double azimuth : {0.0, 0.6, 1.57})
        views.push_back(lit(seen(x, y, facing, azimuth, 64), all));
  }
  return views;
}

bool is_round(const probe::Surface& surface) {
  return surface.alpha_x == surface.alpha_y;
}

// Polynomials of visible normals, in rows of six, as residuals of what they reflect.
struct Residuals {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  bool four;
  std::vector<LitView> views = lit_views(four);
  std::vector<SphericalGaussian> light = lights();
  int inputs() const { return four ? 54 : 12; }
  int values() const { return int(light.size() * views.size()); }

  std::vector<probe::VisibleNormal> normals(const View& view, const VectorXd& k) const {
    const double rho = std::sqrt(std::sqrt(double(view.surface.alpha_x) * double(view.surface.alpha_y)));
    const VectorXd terms = monomials(2, view.openness, rho);
    const auto at = [&](int row) { return float(k.segment(6 * row, 6).dot(terms)); };
    if (!four) return {{0, at(0), 1, at(1)}};
    return {{0, at(0), at(1), at(2)},
            {0, at(3), at(4), at(5)},
            {at(6), at(7), 1, at(8)},
            {-at(6), at(7), 1, at(8)}};
  }
  int operator()(const VectorXd& k, VectorXd& residual) const {
    int at = 0;
    for (const LitView& lit : views) {
      const auto chosen = normals(lit.view, k);
      std::vector<SphericalGaussian> lobes(chosen.size());
      probe::reflect(probe::view_of(lit.view.surface), lit.view.surface, chosen, lobes);
      for (std::size_t i = 0; i < light.size(); ++i) {
        double sum = -double(lit.truth[i]);
        for (const SphericalGaussian& lobe : lobes) sum += double(product_integral(lobe, light[i]).x);
        // Default lobes have sharpness 6. Straight on, the azimuth of the plane of incidence must not show.
        const double straight = four && lit.view.facing > 0.999 && is_round(lit.view.surface) ? 5 : 1;
        residual[at++] = sum * straight * (light[i].sharpness == 6 ? 1 : 0.5);
      }
    }
    return 0;
  }
};

constexpr const char* names_of_four[] = {"NEAR_ALONG",  "NEAR_SHARE", "NEAR_SHARPNESS",
                                         "FAR_ALONG",   "FAR_SHARE",  "FAR_SHARPNESS",
                                         "PAIR_ACROSS", "PAIR_ALONG", "PAIR_SHARPNESS"};
constexpr const char* names_of_one[] = {"MIDDLE_ALONG", "MIDDLE_SHARPNESS"};

VectorXd present_normals(bool four) {
  const double of_four[] = {NOOK_GGX_NEAR_ALONG,  NOOK_GGX_NEAR_SHARE, NOOK_GGX_NEAR_SHARPNESS,
                            NOOK_GGX_FAR_ALONG,   NOOK_GGX_FAR_SHARE,  NOOK_GGX_FAR_SHARPNESS,
                            NOOK_GGX_PAIR_ACROSS, NOOK_GGX_PAIR_ALONG, NOOK_GGX_PAIR_SHARPNESS};
  const double of_one[] = {NOOK_GGX_MIDDLE_ALONG, NOOK_GGX_MIDDLE_SHARPNESS};
  return four ? present(of_four) : present(of_one);
}

VectorXd fitted_normals(Residuals& residuals) {
  VectorXd k = VectorXd::Zero(residuals.inputs());
  const std::vector<double> start =
      residuals.four ? std::vector{-0.5, 1.0, 3.0, 0.5, 1.0, 3.0, 0.5, 0.0, 3.0} : std::vector{0.0, 2.0};
  for (std::size_t i = 0; i < start.size(); ++i) k[6 * Eigen::Index(i)] = start[i];
  Eigen::NumericalDiff<Residuals> differences(residuals, 1e-6);  // lobes are evaluated in floats
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(differences);
  solver.parameters.maxfev = 4000;
  solver.minimize(k);
  return k;
}

bool lobes(bool fit, bool four) {
  Residuals residuals{four};
  const VectorXd k = fit ? fitted_normals(residuals) : present_normals(four);
  VectorXd residual(residuals.values());
  residuals(k, residual);
  const double rms = std::sqrt(residual.squaredNorm() / double(residual.size()));
  if (fit)
    for (Eigen::Index i = 0; 6 * i < k.size(); ++i)
      print(four ? names_of_four[i] : names_of_one[i], k.segment(6 * i, 6));
  std::printf("%s: rms of a light's reflection %.4f\n", four ? "four lobes" : "one lobe", rms);
  return rms < (four ? 0.0062 : 0.011);
}

}  // namespace

int main(int argc, char** argv) {
  const bool fit = argc > 1 && std::string_view(argv[1]) == "fit";
  bool good = true;
  for (const bool part : {albedo(fit), lobes(fit, false), lobes(fit, true)}) good = part && good;
  return good ? 0 : 1;
}
