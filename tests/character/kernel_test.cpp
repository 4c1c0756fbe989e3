// The formulas of kernel.h against closed forms, hand-computed values and numerical integration, in double
// precision.
#include "sdk/src/character/kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/catch.h"

using namespace nook;

namespace {

constexpr double pi = std::numbers::pi;

// Share of the cosine-weighted hemisphere that the unit sphere at distance h and height xi above the horizon
// covers, by Nusselt's analogue: directions are uniform on the unit disk under the hemisphere.
double form_factor_by_integration(double xi, double h) {
  constexpr int steps = 1500;
  const double up = xi / h, side = std::sqrt(std::max(0.0, 1 - up * up));
  const double cos_cone = h > 1 ? std::sqrt(1 - 1 / (h * h)) : 0;
  long hits = 0, total = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double x = (2 * i + 1.0) / steps - 1, y = (2 * j + 1.0) / steps - 1;
      if (x * x + y * y > 1) continue;
      ++total;
      hits += x * side + std::sqrt(1 - x * x - y * y) * up > cos_cone;
    }
  return static_cast<double>(hits) / static_cast<double>(total);
}

// Calls visit(xi, h) over heights from below to above the horizon and distances from `nearest` to 50 radii.
template <class Visit>
void for_each_view(double nearest, Visit visit) {
  for (double h = nearest; h < 50; h *= h < 1.2 ? 1.01 : 1.1)
    for (int i = -60; i <= 60; ++i)
      visit(std::clamp(i / 40.0, -1.0, 1.0) * std::min(h, std::abs(i) > 40 ? h : 1.0), h);
}

}  // namespace

TEST_CASE("the paper's solid angle and visibility have the values of slide 18") {
  // Omega at the surface, 3/4; at the centre 3/4 + 3/5; at 2 radii 3/4 - 3/5. Lambda on the horizon is 1/2.
  CHECK(std::abs(shadow_paper(0.0, 1.0) - 0.75 * 0.5) < 1e-12);
  CHECK(std::abs(shadow_paper(0.0, 0.0) - 1.35 * 0.5) < 1e-12);
  CHECK(std::abs(shadow_paper(0.0, 4.0) - 0.15 * 0.5) < 1e-12);
  CHECK(std::abs(shadow_paper(1.0, 1.0) - 0.75 * (0.5 + 1 / std::sqrt(5.0))) < 1e-12);
  CHECK(std::abs(shadow_paper(-1.0, 1.0) - 0.75 * (0.5 - 1 / std::sqrt(5.0))) < 1e-12);
}

TEST_CASE("the paper's solid angle as one fraction is the printed one") {
  for (double delta = 0.01; delta < 100; delta *= 1.1) {
    const double e = delta - 1;
    const double printed = (0.75 - 3 * e / (1 + 4 * std::abs(e))) * 0.5;
    CHECK(std::abs(shadow_paper(0.0, delta * delta) - printed) < 1e-12);
  }
}

TEST_CASE("the rational form keeps the paper's visibility and falls with the square of distance") {
  CHECK(std::abs(shadow_rational(0.0, 0.0) - 0.75) < 1e-12);
  CHECK(std::abs(shadow_rational(1.0, 1.0) - 0.5 * (0.5 + 1 / std::sqrt(5.0))) < 1e-12);
  // Far above: Omega -> 0.75 / delta^2, Lambda -> 1.
  CHECK(std::abs(shadow_rational(1000.0, 1e6) * 1e6 - 0.75) < 1e-5);
}

TEST_CASE("the nook form is half on the horizon and a far sphere's form factor above it") {
  const double c = nook_kernel_core;
  CHECK(std::abs(shadow_nook(0.0, 0.0) - 0.5 * std::pow(c, -1.5)) < 1e-12);
  CHECK(std::abs(shadow_nook(0.75, 1.0) - 1.0 * std::pow(c + 1, -1.5)) < 1e-12);  // (0.75 + 1.25) / 2 = 1
  CHECK(std::abs(shadow_nook(1000.0, 1e6) * 1e6 - 1) < 1e-4);
  CHECK(std::abs(shadow_nook(-1000.0, 1e6)) < 1e-12);
}

TEST_CASE("shadow_term evaluates the form of its argument") {
  CHECK(shadow_term(KernelForm::paper, 0.3, 2.0) == shadow_paper(0.3, 2.0));
  CHECK(shadow_term(KernelForm::nook, 0.3, 2.0) == shadow_nook(0.3, 2.0));
  CHECK(shadow_term(KernelForm::rational, 0.3, 2.0) == shadow_rational(0.3, 2.0));
}

TEST_CASE("the exact form factor is the integral over the hemisphere") {
  // Cells along the sphere's outline, about 5,000 of 1.8 million, are right or wrong by half: 1e-4, and more
  // where the outline runs along the grid.
  for (const double h : {1.02, 1.2, 1.7, 3.0})
    for (const double xi : {-1.2, -0.9, -0.5, -0.1, 0.0, 0.3, 0.7, 0.95, 1.01, 2.5}) {
      if (std::abs(xi) > h) continue;
      INFO("h " << h << " xi " << xi);
      CHECK(std::abs(form_factor_exact(xi, h * h) - form_factor_by_integration(xi, h)) < 5e-4);
    }
}

TEST_CASE("the exact form factor has its closed limits") {
  CHECK(std::abs(form_factor_exact(3.0, 9.0) - 1.0 / 9) < 1e-12);  // overhead: 1 / h^2
  CHECK(std::abs(form_factor_exact(1.5, 4.0) - 1.5 / 8) < 1e-12);  // wholly above: xi / h^3
  CHECK(form_factor_exact(-1.5, 4.0) == 0);
  // Far on the horizon: 2 / (3 pi h^3), with a relative error of order 1 / h^2.
  CHECK(std::abs(form_factor_exact(0.0, 1e4) * 1e6 - 2 / (3 * pi)) < 1e-3);
  for (const double t : {0.05, 0.3, 0.5, 0.8, 1.0})                 // on the surface: (1 + cosine) / 2
    CHECK(std::abs(form_factor_exact(2 * t - 1, 1.0) - t) < 1e-7);  // 1 / pi is a float
}

TEST_CASE("what a sphere covers above and below the horizon differs by its unclipped form factor") {
  for_each_view(1.0, [](double xi, double h) {
    if (std::abs(xi) >= 1) return;
    const double difference = form_factor_exact(xi, h * h) - form_factor_exact(-xi, h * h);
    CHECK(std::abs(difference - xi / (h * h * h)) < 1e-7);  // 1 / pi is a float
  });
}

TEST_CASE("the form factor rises steadily from the surface to one at the centre") {
  CHECK(form_factor_exact(0.0, 0.0) == 1);
  for (const double cosine : {-1.0, -0.4, 0.0, 0.6, 1.0}) {
    const double at_surface = form_factor_exact(cosine, 1.0);
    CHECK(std::abs(form_factor_exact(cosine * 0.9999, 0.9998) - at_surface) < 1e-3);
    CHECK(form_factor_exact(cosine * 0.5, 0.25) >= std::min(0.75, at_surface));
  }
}

TEST_CASE("the fast form factor stays within its stated error of the exact one") {
  double worst = 0, worst_outside = 0, squares = 0, count = 0;
  for_each_view(1.0, [&](double xi, double h) {
    const double fast = form_factor_fast(xi, h * h), exact = form_factor_exact(xi, h * h);
    CHECK(fast >= 0);
    CHECK(fast <= 1 + 1e-12);
    worst = std::max(worst, std::abs(fast - exact));
    if (h < 1.05) return;
    worst_outside = std::max(worst_outside, std::abs(fast - exact));
    squares += (fast - exact) * (fast - exact);
    count += 1;
    // In proportion to the unclipped value 1 / h^3 the error stays small at any distance.
    CHECK(std::abs(fast - exact) * h * h * h < 0.011);
  });
  // The numbers in kernel.h.
  CHECK(worst < 0.0095);
  CHECK(worst_outside < 0.0055);
  CHECK(std::sqrt(squares / count) < 0.0025);
}

TEST_CASE("the fast form factor is exact where nothing is clipped") {
  for (double h = 1; h < 1000; h *= 1.3)
    for (double xi = 1; xi <= h; xi *= 1.2) {
      CHECK(std::abs(form_factor_fast(xi, h * h) * h * h * h / xi - 1) < 1e-12);
      if (xi > 1) CHECK(form_factor_fast(-xi, h * h) == 0);
    }
}
