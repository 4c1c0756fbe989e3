// Closed forms of spherical Gaussians against quadrature, from sharpness 0 to what quadrature resolves, and
// for being finite and continuous beyond.
#include "sdk/src/core/spherical_gaussian.h"

#include "tests/catch.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;

namespace {

const Vec3 axis_a = normalised({0.3f, -0.5f, 0.8f}), axis_b = normalised({-0.6f, 0.1f, 0.4f});

SphericalGaussian lobe(Vec3 axis, float sharpness) {
  return {axis, sharpness, {1, 2, 0.5f}};
}

// The axis made unit in double: what float lacks, times the sharpness, would be seen.
double at(const SphericalGaussian& g, double x, double y, double z) {
  const double ax = double(g.axis.x), ay = double(g.axis.y), az = double(g.axis.z);
  const double cosine = (ax * x + ay * y + az * z) / std::sqrt(ax * ax + ay * ay + az * az);
  return std::exp(double(g.sharpness) * (cosine - 1));
}

bool near_relative(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::abs(b);
}

}  // namespace

// Simpson's rule with 400 steps has an error below 1e-6 of lobes up to sharpness 100; float arithmetic of the
// closed forms adds 1e-6.
constexpr double closed_form_error = 3e-6;

TEST_CASE("integrals of lobes and of their squares") {
  for (const float sharpness : {0.0f, 1e-6f, 1e-3f, 0.5f, 6.0f, 40.0f, 100.0f}) {
    const SphericalGaussian g = lobe(axis_a, sharpness);
    const auto value_at = [&](double x, double y, double z) { return at(g, x, y, z); };
    const double truth = test::integrate_sphere(value_at);
    CHECK(near_relative(double(gaussian_integral(sharpness)), truth, closed_form_error));
    CHECK(near_relative(double(integral(g).y), 2 * truth, closed_form_error));
    const auto square_at = [&](double x, double y, double z) { return at(g, x, y, z) * at(g, x, y, z); };
    CHECK(near_relative(double(gaussian_square_integral(sharpness)), test::integrate_sphere(square_at),
                        closed_form_error));
  }
}

TEST_CASE("products are lobes, and their integrals closed") {
  for (const float a : {0.0f, 0.1f, 6.0f, 50.0f})
    for (const float b : {0.0f, 2.0f, 30.0f}) {
      const SphericalGaussian g = lobe(axis_a, a), h = lobe(axis_b, b), gh = product(g, h);
      const auto product_at = [&](double x, double y, double z) { return at(g, x, y, z) * at(h, x, y, z); };
      const double truth = test::integrate_sphere(product_at);
      // The exponent, up to 80 here, is float: its rounding of 6e-8 relative becomes 5e-6 of the value.
      CHECK(near_relative(double(product_integral(g, h).y), 4 * truth, 1e-5));
      CHECK(near_relative(double(integral(gh).y), 4 * truth, 1e-5));
      for (const Vec3 s : {axis_a, axis_b, Vec3{0, 0, 1}})
        CHECK(near_relative(double(value(gh, s).z), double(value(g, s).z * value(h, s).z), 1e-4));
    }
}

TEST_CASE("huge sharpnesses neither overflow nor cancel") {
  for (const float sharpness : {1e3f, 1e4f, 1e6f}) {
    const SphericalGaussian g = lobe(axis_a, sharpness);
    CHECK(near_relative(double(gaussian_integral(sharpness)), 6.283185307 / double(sharpness), 1e-5));
    CHECK(near_relative(double(product_integral(g, g).x), 3.141592654 / double(sharpness), 1e-5));
    CHECK(product_integral(g, lobe(-axis_a, sharpness)).x == 0);
    // A lobe meets a broad one as a point would.
    CHECK(near_relative(double(product_integral(g, lobe(axis_b, 5)).x),
                        double(gaussian_integral(sharpness) * gaussian_value(axis_b, 5, axis_a)), 2e-2));
    const SphericalGaussian blurred = convolution(g, g);
    CHECK(near_relative(double(blurred.sharpness), double(sharpness) / 2, 1e-2));
  }
}

TEST_CASE("convolution keeps integral and mean cosine") {
  // The truth at one direction is the product integral with the filter turned there; its integral and its
  // mean cosine are products, as bands 0 and 1 of every convolution are.
  for (const float a : {0.02f, 1.0f, 12.0f})
    for (const float b : {0.5f, 8.0f, 60.0f}) {
      const SphericalGaussian blurred = convolution(lobe(axis_a, a), {axis_b, b, {1, 1, 1}});
      const double mass = double(integral(blurred).x);
      CHECK(near_relative(mass, double(gaussian_integral(a) * gaussian_integral(b)), 1e-5));
      const auto mean_of = [](float sharpness) {
        const auto along = [&](double, double, double z) {
          return z * std::exp(double(sharpness) * (z - 1));
        };
        return test::integrate_sphere(along) / double(gaussian_integral(sharpness));
      };
      CHECK(std::abs(mean_of(blurred.sharpness) - mean_of(a) * mean_of(b)) < 2e-5);
      CHECK(blurred.axis == axis_a);
      // Near the true one everywhere: within 6 % of its peak, because a lobe replaces a function that is not
      // a lobe.
      double worst = 0, peak = 0;
      for (int i = 0; i <= 20; ++i) {
        const float angle = 0.157f * float(i);
        const Vec3 across = normalised(cross(axis_a, axis_b));
        const Vec3 d = axis_a * std::cos(angle) + across * std::sin(angle);
        const float truth = gaussian_product_integral(a, b, one_minus_cosine(axis_a, d));
        peak = std::max(peak, double(truth));
        worst = std::max(worst, std::abs(double(value(blurred, d).x) - double(truth)));
      }
      CHECK(worst < 0.06 * peak);
    }
}

TEST_CASE("bands are Legendre moments") {
  for (const double sharpness : {0.0, 1e-4, 0.3, 4.0, 15.9, 16.1, 80.0}) {
    const auto bands = gaussian_bands(sharpness);
    for (int l = 0; l <= 4; ++l) {
      const auto moment = [&](double, double, double z) {
        return std::legendre(unsigned(l), z) * std::exp(sharpness * (z - 1));
      };
      const double truth = test::integrate_sphere(moment) / gaussian_integral(sharpness);
      CHECK(std::abs(bands[std::size_t(l)] - truth) < 1e-6);  // Simpson's error at sharpness 80
      CHECK(std::abs(double(gaussian_bands(float(sharpness))[std::size_t(l)]) - truth) < 2e-6);
    }
  }
}

TEST_CASE("irradiance of a lobe, all forms, against quadrature") {
  // The error bound of each form, in units of a light's full irradiance; at 400 the quadrature itself has
  // 1e-4.
  const auto fitted_error = [](float s) { return s < hill_min_sharpness ? 3e-4 : 1.65e-2; };
  const auto best_error = [](float s) {
    return s <= 3 ? 3e-4 : s <= 6 ? 1.7e-3 : s <= 16 ? 1.1e-2 : 1.65e-2;
  };
  for (const float sharpness : {0.0f, 1e-5f, 0.05f, 1.0f, 2.9f, 3.1f, 6.0f, 16.0f, 30.0f, 100.0f, 400.0f})
    for (int i = 0; i <= 16; ++i) {
      const double cosine = std::cos(i * std::numbers::pi / 16), sine = std::sin(i * std::numbers::pi / 16);
      const auto lit = [&](double x, double, double z) {
        return z * std::exp(double(sharpness) * (x * sine + z * cosine - 1));
      };
      const double truth = test::integrate_sphere(lit, 0, std::numbers::pi / 2, 600, 300) /
                           double(gaussian_integral(sharpness));
      CHECK(std::abs(double(gaussian_unit_irradiance_fitted(sharpness, float(cosine))) - truth) <
            fitted_error(sharpness));
      CHECK(std::abs(double(gaussian_unit_irradiance_best(sharpness, float(cosine))) - truth) <
            best_error(sharpness));
      if (sharpness > 16) continue;  // the inner product is for broad lobes
      const Vec3 n{float(sine), 0, float(cosine)};
      const float inner = gaussian_irradiance_inner_product({0, 0, 1}, sharpness, n);
      CHECK(std::abs(double(inner / gaussian_integral(sharpness)) - truth) < 0.1);
    }
}

TEST_CASE("irradiance of any sharpness is finite and never negative") {
  for (float sharpness = 1e-30f; sharpness < 1e9f; sharpness *= 3)
    for (const float cosine : {-1.0f, -0.3f, 0.0f, 0.7f, 1.0f}) {
      const float fitted = gaussian_unit_irradiance_fitted(sharpness, cosine);
      const float best = gaussian_unit_irradiance_best(sharpness, cosine);
      REQUIRE((fitted >= 0 && fitted <= 1.001f));
      REQUIRE((best >= 0 && best <= 1.001f));
    }
}
