// Numerical integration in double precision. The points and weights are compile-time constants.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace nook::probe {

// Returns the cosine of an angle in [0, pi], with an error below 1e-9. It is the initial value of an
// iteration. std::cos cannot be used because it is not constexpr.
constexpr double starting_cosine(double angle) {
  double term = 1, sum = 1;
  for (int n = 1; n <= 14; ++n) {
    term *= -angle * angle / ((2 * n - 1) * (2 * n));
    sum += term;
  }
  return sum;
}

// The Gauss-Legendre rule on [-1, 1], which is exact for polynomials of degree 2 N - 1.
template <int N>
struct GaussLegendre {
  std::array<double, N> node{}, weight{};

  constexpr GaussLegendre() {
    for (int i = 0; i < N; ++i) {
      double x = starting_cosine(std::numbers::pi * (i + 0.75) / (N + 0.5)), slope = 1;
      for (int step = 0; step < 8; ++step) {
        double p = 1, before = 0;
        for (int n = 0; n < N; ++n) {
          const double next = ((2 * n + 1) * x * p - n * before) / (n + 1);
          before = p;
          p = next;
        }
        slope = N * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      node[std::size_t(i)] = x;
      weight[std::size_t(i)] = 2 / ((1 - x * x) * slope * slope);
    }
  }

  template <class Function>
  double operator()(double from, double to, Function&& f) const {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (int i = 0; i < N; ++i) sum += weight[std::size_t(i)] * f(middle + half * node[std::size_t(i)]);
    return sum * half;
  }
};

}  // namespace nook::probe
