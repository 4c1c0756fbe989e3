// The distance of the running average from the exact least-squares fit, for smooth functions and independent
// samples, over 20 seeds.
#include "sdk/src/probe/dense.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

// Skies whose fit leaves from 4 to 40 % of them: polynomials, a broad sun, an edge.
Vec3 sky(Vec3 d) {
  const float t = 1 + 0.8f * d.x + d.y * d.z + 0.5f * d.z * d.z * d.x;
  return {t * t, 1 + 0.5f * d.y + d.x * d.z, std::exp(1.5f * d.z + d.x * d.y)};
}
Vec3 room(Vec3 d) {
  const float window = gaussian_value(Vec3{0.6f, 0.64f, 0.48f}, 25, d);
  return {0.4f + 6 * window, 0.3f + 5 * window + 0.2f * d.z, 0.2f + 4 * window};
}
Vec3 horizon(Vec3 d) {
  const float up = 1 / (1 + std::exp(-12 * d.z));
  return {0.2f + up, 0.2f + 1.2f * up + 0.1f * d.x, 0.1f + 2 * up * (1.2f - d.z)};
}

struct Truth {
  Coefficients b;
  double norm = 0;      // of the fit, squared, integrated
  double residual = 0;  // of the function minus the fit
};

Truth exact_fit(const Basis& basis, const nook::Vector<double>& gram, Vec3 (*f)(Vec3)) {
  const std::uint32_t n = basis.count;
  std::vector<double> factor(gram.begin(), gram.end()), moments(3 * n);
  const auto moment = [&](std::uint32_t i, int c) {
    const auto integrand = [&](double x, double y, double z) {
      const Vec3 d{float(x), float(y), float(z)}, v = f(d);
      const float channel[3] = {v.x, v.y, v.z};
      return double(channel[c]) * double(gaussian_value(basis.axis[i], basis.sharpness[i], d));
    };
    return basis.domain == Domain::sphere
               ? test::integrate_sphere(integrand, 0, std::numbers::pi, 120, 64)
               : test::integrate_sphere(integrand, 0, std::numbers::pi / 2, 80, 64);
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) moments[3 * i + std::uint32_t(c)] = moment(i, c);
  cholesky(factor.data(), n, 0);
  for (std::uint32_t c = 0; c < 3; ++c) cholesky_solve(factor.data(), n, moments.data() + c, 3);
  Truth truth;
  for (std::uint32_t i = 0; i < n; ++i)
    truth.b.push_back({float(moments[3 * i]), float(moments[3 * i + 1]), float(moments[3 * i + 2])});
  truth.norm = test::squared_norm(gram, truth.b);
  const auto power = [&](double x, double y, double z) {
    const Vec3 v = f({float(x), float(y), float(z)});
    return double(dot(v, v));
  };
  const double total =
      basis.domain == Domain::sphere ? test::integrate_sphere(power) : test::integrate_hemisphere(power);
  truth.residual = total - truth.norm;
  return truth;
}

// Mean squared distance to the exact fit over the seeds, after 1,024 and 20,000 samples.
struct Distances {
  double early = 0, late = 0;
};

Distances distances(const Basis& basis, const nook::Vector<double>& gram, const Truth& truth,
                    FitMethod method, Vec3 (*f)(Vec3)) {
  constexpr int seeds = 20;
  Distances mean;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const test::Samples samples = test::sample(seed, 20000, f, basis.domain);
    FitSettings settings;
    settings.constraint = Constraint::none;
    settings.method = method;
    Fit fit(basis, settings);
    test::add(fit, samples, 0, 1024);
    mean.early += test::squared_distance(gram, test::read(fit), truth.b) / seeds;
    test::add(fit, samples, 1024);
    mean.late += test::squared_distance(gram, test::read(fit), truth.b) / seeds;
  }
  return mean;
}

}  // namespace

TEST_CASE("the running average comes within a small factor of batch least squares") {
  for (const Basis& basis : {vogel_basis(12), vogel_basis(12, true),
                             vogel_basis(12, false, Domain::hemisphere), vogel_basis(24)}) {
    const auto gram = basis_gram(basis);
    for (const auto f : {sky, room, horizon}) {
      const Truth truth = exact_fit(basis, gram, f);
      REQUIRE(truth.residual > 0.002 * truth.norm);
      const Distances batch = distances(basis, gram, truth, FitMethod::least_squares, f);
      const Distances running = distances(basis, gram, truth, FitMethod::running_average, f);
      INFO("functions " << basis.count << " residual " << truth.residual / truth.norm << " excess "
                        << running.early / truth.residual << " " << running.late / truth.residual << " batch "
                        << batch.early / truth.residual << " " << batch.late / truth.residual);
      // Excess of the mean square error over the best fit's. 24 functions have twice the variance of 12.
      const double functions = double(basis.count) / 12;
      CHECK(running.early < 0.04 * functions * truth.residual);
      CHECK(running.late < 0.005 * truth.residual);
      // The factor to batch least squares on the same samples: it tends to 1. At the start the 24 functions
      // have half as many samples each.
      CHECK(running.early < (basis.count < 24 ? 2 : 3) * batch.early);
      CHECK(running.late < 1.2 * batch.late);
      CHECK(running.early < 0.04 * functions * truth.norm);
    }
  }
}

TEST_CASE("the error falls as one over the number of samples") {
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis);
  const Truth truth = exact_fit(basis, gram, room);
  for (const FitMethod method : {FitMethod::running_average, FitMethod::moments, FitMethod::least_squares}) {
    const Distances d = distances(basis, gram, truth, method, room);
    const double power = std::log(d.early / d.late) / std::log(20000.0 / 1024);
    CHECK(power > 0.8);  // the spread of 20 seeds' means allows 0.15
    CHECK(power < 1.3);
  }
}

TEST_CASE("millions of samples do not wear the floats out") {
  // The same 2^18 samples twenty times. Coefficients in floats alone would gather the rounding of 5 million
  // steps, of the order of 1e-4 of their size; what is left here is the order of the last pass.
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis);
  const test::Samples samples = test::sample(1, 1u << 18, sky);
  FitSettings settings;
  settings.constraint = Constraint::none;
  settings.method = FitMethod::least_squares;
  Fit batch(basis, settings);
  settings.method = FitMethod::running_average;
  Fit running(basis, settings);
  test::add(batch, samples);
  for (int pass = 0; pass < 20; ++pass) test::add(running, samples);
  const double apart = test::squared_distance(gram, test::read(running), test::read(batch));
  CHECK(apart < 1e-6 * test::squared_norm(gram, test::read(batch)));
}
