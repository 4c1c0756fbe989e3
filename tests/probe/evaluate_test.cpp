// Radiance and irradiance of probes against quadrature, interpolation, and conversion to harmonics.
#include "sdk/src/probe/probe_light.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

Coefficients some(const Basis& basis) {
  Coefficients b;
  for (std::uint32_t i = 0; i < basis.count; ++i)
    b.push_back({1 + 0.5f * std::sin(float(i)), 0.3f, float(i % 3) * 0.4f});
  return b;
}

// Irradiance of channel x by brute force; the functions, not the fit's shortcuts.
double lit(const Basis& basis, const Coefficients& b, Vec3 n) {
  const auto integrand = [&](double x, double y, double z) {
    const double cosine = double(n.x) * x + double(n.y) * y + double(n.z) * z;
    if (cosine <= 0) return 0.0;
    const double d[3] = {x, y, z};
    double values[max_functions], sum = 0;
    evaluate_basis(basis, d, values);
    for (std::uint32_t i = 0; i < basis.count; ++i) sum += double(b[i].x) * values[i];
    return sum * cosine;
  };
  return test::integrate_sphere(integrand);
}

}  // namespace

TEST_CASE("irradiance of every basis against quadrature") {
  test::Directions directions(3);
  for (const Basis& basis : {vogel_basis(12, true), harmonic_basis(2), harmonic_basis(4), dice_basis()}) {
    const Coefficients b = some(basis);
    double full = 0;
    for (int i = 0; i < 6; ++i) {
      const Vec3 n = directions.next();
      const double truth = lit(basis, b, n);
      full = std::max(full, truth);
      // Simpson's rule across the horizon's kink: 1e-4. Lobes of sharpness 6: what the forms promise for full
      // lights, where a few overlap.
      const bool lobes = basis.kind == BasisKind::gaussians;
      CHECK(std::abs(double(irradiance(basis, b, IrradianceForm::fitted, n).x) - truth) <
            (lobes ? 0.02 : 2e-4) * full);
      CHECK(std::abs(double(irradiance(basis, b, IrradianceForm::bands, n).x) - truth) <
            (lobes ? 0.003 : 2e-4) * full);
      CHECK(std::abs(double(irradiance(basis, b, IrradianceForm::inner_product, n).x) - truth) <
            (lobes ? 0.1 : 2e-4) * full);
    }
  }
}

TEST_CASE("lobes and their basis evaluate alike") {
  const Basis basis = vogel_basis(12, true);
  const Coefficients b = some(basis);
  std::vector<SphericalGaussian> lobes(basis.count);
  to_lobes(basis, b, lobes);
  test::Directions directions(8);
  for (int i = 0; i < 20; ++i) {
    const Vec3 d = directions.next();
    CHECK(length(radiance(lobes, d) - radiance(basis, b, d)) < 1e-5f);
    for (const IrradianceForm form :
         {IrradianceForm::fitted, IrradianceForm::inner_product, IrradianceForm::bands})
      CHECK(length(irradiance(lobes, form, d) - irradiance(basis, b, form, d)) < 1e-5f);
  }
}

TEST_CASE("lobes as harmonics: the projection itself, and the same irradiance") {
  const Basis basis = vogel_basis(5, true);
  const Coefficients b = some(basis);
  std::vector<SphericalGaussian> lobes(basis.count);
  to_lobes(basis, b, lobes);
  for (const std::uint32_t order : {1u, 2u, 4u}) {
    Coefficients projected(harmonic_count(order));
    to_harmonics(lobes, order, projected);
    for (std::uint32_t i = 0; i < projected.size(); ++i) {
      const auto moment = [&](double x, double y, double z) {
        double values[25];
        evaluate_harmonics(order, x, y, z, values);
        return values[i] * double(radiance(lobes, {float(x), float(y), float(z)}).x);
      };
      CHECK(std::abs(double(projected[i].x) - test::integrate_sphere(moment, 0, std::numbers::pi, 100, 60)) <
            2e-5);
    }
  }
  // Band 4 and the clamped cosine's zeros at odd bands leave irradiance within what lies in band 6 and above:
  // 0.1 % for these lobes of sharpness 2.5.
  Coefficients l4(25);
  to_harmonics(lobes, 4, l4);
  test::Directions directions(2);
  for (int i = 0; i < 10; ++i) {
    const Vec3 n = directions.next();
    const double truth = lit(basis, b, n);
    CHECK(std::abs(double(irradiance(harmonic_basis(4), l4, IrradianceForm::fitted, n).x) - truth) <
          2e-3 * truth);
  }
}

TEST_CASE("a grid is interpolated between its probes and clamped at its ends") {
  Probes probes;
  probes.basis = vogel_basis(3);
  probes.grid.counts = {3, 2, 2};
  probes.grid.origin_ws = {-1, 0, 2};
  probes.grid.spacing_ws = {0.5f, 2, 1};
  // Linear in position, which trilinear weights give back.
  const auto linear = [](Vec3 p, std::uint32_t i) { return Vec3{p.x + float(i), 2 * p.y, p.z - p.x}; };
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        for (std::uint32_t i = 0; i < 3; ++i)
          probes.coefficients.push_back(linear({-1 + 0.5f * float(x), 2 * float(y), 2 + float(z)}, i));
  check_probes(probes, NOOK_ERROR_INVALID_ARGUMENT);
  Coefficients read(3);
  for (const Vec3 p : {Vec3{-1, 0, 2}, Vec3{0, 2, 3}, Vec3{-0.3f, 0.7f, 2.9f}, Vec3{-0.5f, 1, 2}}) {
    interpolate(probes, p, read);
    for (std::uint32_t i = 0; i < 3; ++i) CHECK(length(read[i] - linear(p, i)) < 1e-5f);
  }
  interpolate(probes, {-100, 50, 2.5f}, read);
  CHECK(length(read[1] - linear({-1, 2, 2.5f}, 1)) < 1e-5f);
  interpolate(probes, {NAN, INFINITY, -INFINITY}, read);
  CHECK(length(read[0] - linear({-1, 2, 2}, 0)) < 1e-5f);
}

TEST_CASE("grids and coefficients out of range are refused") {
  const auto refused = [](auto&& change) {
    Probes probes;
    probes.basis = vogel_basis(2);
    probes.coefficients.resize(2);
    change(probes);
    CHECK_THROWS_AS(check_probes(probes, NOOK_ERROR_INVALID_ARGUMENT), Failure);
  };
  refused([](Probes& p) { p.grid.counts = {0, 1, 1}; });
  refused([](Probes& p) { p.grid.counts = {1u << 16, 1u << 16, 1u << 16}; });
  refused([](Probes& p) { p.grid.counts = {2, 1, 1}; });
  refused([](Probes& p) { p.grid.spacing_ws.y = 0; });
  refused([](Probes& p) { p.grid.origin_ws.z = NAN; });
  refused([](Probes& p) { p.coefficients[1].y = INFINITY; });
}
