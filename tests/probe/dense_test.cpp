#include "sdk/src/probe/dense.h"

#include <random>
#include <vector>

#include "sdk/src/probe/basis.h"
#include "tests/catch.h"

using namespace nook::probe;

namespace {

struct System {
  std::uint32_t n;
  std::vector<double> g, b;

  // g = m^T m + ridge: positive definite, the less the smaller the ridge.
  System(std::uint32_t size, std::uint32_t seed, double ridge = 1e-3) : n(size), g(size * size), b(size) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> m(n * n);
    for (double& value : m) value = normal(random);
    for (double& value : b) value = normal(random);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j) g[i * n + k] += m[j * n + i] * m[j * n + k];
        if (i == k) g[i * n + k] += ridge;
      }
  }
  double slope(const std::vector<double>& x, std::size_t i) const {
    double sum = -b[i];
    for (std::size_t k = 0; k < n; ++k) sum += g[i * n + k] * x[k];
    return sum;
  }
};

}  // namespace

TEST_CASE("Cholesky solves, and finds the row that depends on others") {
  for (const std::uint32_t n : {1u, 2u, 7u, 30u}) {
    const System system(n, n);
    std::vector<double> l = system.g, x(3 * n);
    for (std::size_t i = 0; i < n; ++i) x[3 * i + 1] = system.b[i];
    REQUIRE(cholesky(l.data(), n, 1e-12) == n);
    cholesky_solve(l.data(), n, x.data() + 1, 3);
    std::vector<double> answer(n);
    for (std::size_t i = 0; i < n; ++i) answer[i] = x[3 * i + 1];
    // The ridge bounds the condition at about 1e5; times double's rounding and the answer's size.
    for (std::size_t i = 0; i < n; ++i) CHECK(std::abs(system.slope(answer, i)) < 1e-8);
  }
  System system(6, 3);
  for (std::size_t k = 0; k < 6; ++k) system.g[4 * 6 + k] = system.g[1 * 6 + k];
  for (std::size_t k = 0; k < 6; ++k) system.g[k * 6 + 4] = system.g[k * 6 + 1];
  CHECK(cholesky(system.g.data(), 6, 1e-9) == 4);
}

TEST_CASE("non-negative solutions satisfy the conditions of optimality") {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const std::uint32_t n = 1 + seed % 14;
    const System system(n, seed);
    std::vector<double> x(n), scratch(n * n + 2 * n);
    non_negative_solve(system.g.data(), system.b.data(), n, x.data(), scratch.data());
    for (std::size_t i = 0; i < n; ++i) {
      REQUIRE(x[i] >= 0);
      // Where x is positive the slope is 0; where it is 0, growing it does not help.
      if (x[i] > 0)
        REQUIRE(std::abs(system.slope(x, i)) < 1e-8);
      else
        REQUIRE(system.slope(x, i) > -1e-8);
    }
  }
}

TEST_CASE("a singular system still has a non-negative answer") {
  // Two equal variables: only their sum matters.
  const double g[] = {2, 2, 1, 2, 2, 1, 1, 1, 3}, b[] = {2, 2, -1};
  double x[3], scratch[3 * 3 + 2 * 3];
  non_negative_solve(g, b, 3, x, scratch);
  CHECK(x[2] == 0);
  CHECK(x[0] >= 0);
  CHECK(x[1] >= 0);
  CHECK(std::abs(x[0] + x[1] - 1) < 1e-12);
}
