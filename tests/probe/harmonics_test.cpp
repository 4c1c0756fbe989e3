// Spherical harmonics and their zonal form against quadrature.
#include <cmath>
#include <vector>

#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;

namespace {

constexpr double pi = 3.141592653589793;

// A light of bands 0 to 2 alone, positive everywhere: harmonics are exact for it.
double smooth(double x, double y, double z) {
  return 2 + 0.6 * x - 0.3 * y + 0.4 * z + 0.5 * x * y - 0.2 * (3 * z * z - 1) + 0.3 * x * z;
}

// One channel's coefficients of bands 0 to 2, in three channels.
std::vector<Vec3> coefficients_of(double (*light)(double, double, double)) {
  std::vector<Vec3> c(9);
  for (std::size_t i = 0; i < 9; ++i) {
    const double value = test::integrate_sphere([&](double x, double y, double z) {
      double values[9];
      evaluate_harmonics(2, x, y, z, values);
      return light(x, y, z) * values[i];
    });
    c[i] = Vec3{1, 0.5f, 2} * float(value);
  }
  return c;
}

double irradiance_of(double (*light)(double, double, double), Vec3 n) {
  return test::integrate_sphere([&](double x, double y, double z) {
    return light(x, y, z) * std::max(double(n.x) * x + double(n.y) * y + double(n.z) * z, 0.0);
  });
}

}  // namespace

TEST_CASE("irradiance of harmonics is the integral of the light under the cosine") {
  const std::vector<Vec3> c = coefficients_of(smooth);
  test::Directions directions(5);
  for (int i = 0; i < 20; ++i) {
    const Vec3 n = directions.next();
    const Vec3 rgb = radiance(harmonic_basis(2), c, n);
    const Vec3 e = irradiance(harmonic_basis(2), c, IrradianceForm::bands, n);
    CHECK(std::abs(double(rgb.x) - smooth(double(n.x), double(n.y), double(n.z))) < 1e-4);
    const double truth = irradiance_of(smooth, n);
    // The rule's error at the cosine's horizon.
    CHECK(std::abs(double(e.x) / truth - 1) < 1e-3);
    CHECK(std::abs(e.z / e.y - 4) < 1e-4);
  }
}

TEST_CASE("zonal harmonics hold all of a light that is symmetric round an axis") {
  // Of (s . a)^2 and s . a, with a off all coordinate axes.
  const auto zonal_light = [](double x, double y, double z) {
    const double along = (0.48 * x + 0.6 * y + 0.64 * z);
    return 1.5 + along + 0.8 * along * along;
  };
  const std::vector<Vec3> c = coefficients_of(zonal_light);
  const auto zonal = to_zonal(c);
  test::Directions directions(6);
  for (int i = 0; i < 20; ++i) {
    const Vec3 n = directions.next();
    const Vec3 rgb = zonal_radiance(zonal, n), e = zonal_irradiance(zonal, n);
    CHECK(std::abs(double(rgb.x) / zonal_light(double(n.x), double(n.y), double(n.z)) - 1) < 1e-4);
    CHECK(std::abs(double(e.x) / irradiance_of(zonal_light, n) - 1) < 1e-3);
  }
}

TEST_CASE("zonal harmonics lie between bands 0 to 1 and bands 0 to 2") {
  const std::vector<Vec3> c = coefficients_of(smooth);
  const auto zonal = to_zonal(c);
  double linear = 0, of_zonal = 0;
  test::Directions directions(7);
  for (int i = 0; i < 400; ++i) {
    const Vec3 n = directions.next();
    const float full = irradiance(harmonic_basis(2), c, IrradianceForm::bands, n).x;
    const float first = irradiance(harmonic_basis(1), std::span(c).first(4), IrradianceForm::bands, n).x;
    linear += double((first - full) * (first - full));
    of_zonal += double((zonal_irradiance(zonal, n).x - full) * (zonal_irradiance(zonal, n).x - full));
  }
  CHECK(of_zonal > 0);
  CHECK(of_zonal < linear);
  // Without a direction the axis is +z, and nothing divides by 0.
  std::vector<Vec3> ambient(9);
  ambient[0] = {1, 1, 1};
  CHECK(std::abs(zonal_irradiance(to_zonal(ambient), {0, 0, 1}).x - float(pi) * 0.28209479f) < 1e-5f);
}
