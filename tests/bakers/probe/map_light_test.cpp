// Exact integrals of maps against closed forms and quadrature.
#include "bakers/probe/map_light.h"

#include <cmath>
#include <numbers>

#include "bakers/measure/probe/fit_error.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::probe;
using namespace nook::test;

namespace {

constexpr double pi = std::numbers::pi;

// The first texels of a gradient from the horizon to the pole.
Vec3 sky(Vec3 d) {
  return {1, d.y > 0 ? d.y : 0, 0.25f};
}

}  // namespace

TEST_CASE("integrals of a constant map and of a half one") {
  const Environment map = map_of(32, 16, [](Vec3 d) { return Vec3{2, d.y > 0 ? 3.0f : 0.0f, 0}; });
  const MapIntegrals whole = integrate(map, {});
  CHECK(std::abs(whole.radiance[0] - 8 * pi) < 1e-10);  // rounding of doubles
  CHECK(std::abs(whole.radiance[1] - 6 * pi) < 1e-10);
  CHECK(std::abs(whole.square[1] - 18 * pi) < 1e-10);
  const MapIntegrals half = integrate(map, {Domain::hemisphere, {0, 1, 0}});
  CHECK(std::abs(half.radiance[0] - 4 * pi) < 1e-10);
  CHECK(std::abs(half.radiance[1] - 6 * pi) < 1e-10);
}

TEST_CASE("moments of a constant map are the functions' integrals, however sharp") {
  const Environment map = map_of(64, 32, [](Vec3) { return Vec3{1, 2, 0}; });
  std::array<Vec3, 3> axes{Vec3{0, 1, 0}, normalised({1, 0.3f, -0.2f}), normalised({-0.4f, -0.7f, 0.5f})};
  for (float sharpness : {1.0f, 30.0f, 2000.0f}) {
    const std::array<float, 3> sharpnesses{sharpness, sharpness, sharpness};
    const Basis basis = nook::probe::gaussian_basis(axes, sharpnesses, true);
    const std::vector<Channels> moment = moments(map, basis);
    for (std::size_t i = 0; i < 4; ++i) {
      const double expected = gaussian_integral(i < 3 ? double(sharpness) : 0.0);
      // The midpoint rule: the rings round the pole span up to a fifth of the lobe, 0.22^2 / 24.
      CHECK(std::abs(moment[i][0] / expected - 1) < 3e-3);
      CHECK(std::abs(moment[i][1] / expected - 2) < 6e-3);
      CHECK(moment[i][2] == 0);
    }
  }
}

TEST_CASE("irradiance of a sky that is as bright as it is high") {
  const Environment map = map_of(256, 128, sky);
  const std::array<Vec3, 3> normals{Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}};
  const std::vector<Vec3> e = map_irradiance(map, {}, normals);
  // Texels of 0.7 degrees: 2e-4. Green: 2 pi integral of c^2 = 2 pi / 3; sideways the integral of sin^2 cos
  // phi cos = 2/3.
  CHECK(std::abs(double(e[0].x) / pi - 1) < 2e-4);
  CHECK(std::abs(double(e[2].x) / pi - 1) < 2e-4);
  CHECK(std::abs(double(e[0].y) / (2 * pi / 3) - 1) < 3e-4);
  CHECK(std::abs(double(e[2].y) / (2.0 / 3) - 1) < 1e-3);
  CHECK(std::abs(double(e[1].y)) < 1e-6);
  const std::vector<Vec3> upper = map_irradiance(map, {Domain::hemisphere, {0, 1, 0}}, normals);
  CHECK(std::abs(double(upper[0].x) / pi - 1) < 2e-4);
  CHECK(std::abs(double(upper[2].x) / (pi / 2) - 1) < 2e-4);
  CHECK(upper[1].x < 1e-6f);
}

TEST_CASE("a reduced map holds the same light") {
  const Environment map = uneven_map(), half = reduced(map, 32);
  REQUIRE(half.width() == 32);
  const MapIntegrals a = integrate(map, {}), b = integrate(half, {});
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(b.radiance[c] / a.radiance[c] - 1) < 1e-6);  // floats
  CHECK(reduced(map, 1).width() == 2);  // one row cannot be halved
}

TEST_CASE("errors of a fit agree with quadrature over the map") {
  const Environment map = uneven_map();
  for (const Basis& basis : {nook::probe::vogel_basis(8, true), nook::probe::harmonic_basis(2),
                             nook::probe::vogel_basis(6, false, Domain::hemisphere, {0, 1, 0})}) {
    const ExactFit exact(map, basis);
    std::vector<Vec3> b = exact.coefficients();
    CHECK(exact.excess(b) < 1e-6);  // rounded to floats
    for (std::size_t i = 0; i < b.size(); ++i) b[i] += Vec3{0.1f * float(i), -0.2f, 0.3f};
    double square = 0, area = 0, mean = 0, light = 0;
    // Finer than the map, whose texels are constant.
    const Environment fine(512, 256, std::vector<float>(3 * 512 * 256));
    for (std::size_t at = 0; at < fine.texel_count(); ++at) {
      const Vec3 d = fine.direction(std::uint32_t(at % 512), std::uint32_t(at / 512), 0.5f, 0.5f);
      if (!region_of(basis).holds(d)) continue;
      const double weight = fine.solid_angle(std::uint32_t(at / 512));
      const Vec3 r = nook::probe::radiance(basis, b, d), f = map.radiance(d), e = r - f;
      square += weight * double(dot(e, e));
      mean += weight * double(luminance(r));
      light += weight * double(luminance(f));
      area += weight;
    }
    CHECK(std::abs(exact.square_error(b) / square - 1) < 1e-3);  // midpoint rules at 0.7 and 5.6 degrees
    CHECK(std::abs(exact.rms(b) / std::sqrt(square / (3 * area)) - 1) < 1e-3);
    CHECK(std::abs(exact.mean_ratio(b) - mean / light) < 2e-3);
  }
}

TEST_CASE("the irradiance of a lobe as a map and as a probe agree") {
  const Basis basis = nook::probe::vogel_basis(12);
  std::vector<Vec3> b(12);
  b[4] = {1, 2, 3};
  const Environment map = map_of(256, 128, [&](Vec3 d) { return nook::probe::radiance(basis, b, d); });
  const auto error = IrradianceTruth(map, {}).error(basis, b);
  // Bands are within 1.5e-3 of a lobe's integral, 1.05 x 3 here.
  CHECK(error.rms < 5e-3);
  CHECK(error.minimum >= 0);
}
