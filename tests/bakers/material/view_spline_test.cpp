#include "bakers/material/view_spline.h"

#include <cmath>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/parabolic.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;

TEST_CASE("spline weights reproduce the views, constants and planes of the parabolic map") {
  const auto views = spiral_directions(40, 75);
  const auto at_views = spline_weights(views, views);
  for (Eigen::Index i = 0; i < 40; ++i)
    for (Eigen::Index k = 0; k < 40; ++k) REQUIRE(at_views(i, k) == Approx(i == k ? 1 : 0).margin(1e-4));

  const auto between = spiral_directions(300, 74);
  const auto weights = spline_weights(views, between);
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    float sum = 0, x = 0;
    for (Eigen::Index k = 0; k < 40; ++k) {
      sum += weights(j, k);
      x += weights(j, k) * nook::material::to_parabolic(views[std::size_t(k)]).x;
    }
    REQUIRE(sum == Approx(1).margin(1e-4));
    REQUIRE(x == Approx(nook::material::to_parabolic(between[std::size_t(j)]).x).margin(1e-4));
  }
}

TEST_CASE("the spline follows a smooth function closely, and stays bounded beyond the outermost view") {
  const auto views = spiral_directions(100, 75);
  const auto smooth = [](Vec3 d) { return std::sin(2 * d.x) * std::cos(d.y) + d.z; };
  const auto between = spiral_directions(333, 70);
  const auto weights = spline_weights(views, between);
  double square = 0;
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    float value = 0;
    for (Eigen::Index k = 0; k < 100; ++k) value += weights(j, k) * smooth(views[std::size_t(k)]);
    square += std::pow(double(value - smooth(between[std::size_t(j)])), 2);
  }
  // The nearest view instead is off by 0.1 in the mean; the spline by less than a fiftieth of that.
  CHECK(std::sqrt(square / 333) < 2e-3);

  const auto map = spline_weights(views, 16u);
  REQUIRE(map.rows() == 256);
  CHECK(map.rowwise().sum().isApproxToConstant(1, 1e-3f));
  // No weight beyond what interpolation between neighbours needs.
  CHECK(map.cwiseAbs().maxCoeff() < 1.5f);
}
