// Integrals over the sphere or the hemisphere round +z by brute force: Simpson's rule in the angle from z,
// equal steps in azimuth, which converge faster than any power for smooth functions.
#pragma once

#include <cmath>
#include <numbers>

namespace nook::test {

// f(x, y, z) of unit directions; from and to are angles from +z.
template <class Function>
double integrate_sphere(Function&& f, double from = 0, double to = std::numbers::pi, int steps = 400,
                        int azimuths = 200) {
  double total = 0;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
    double ring = 0;
    for (int k = 0; k < azimuths; ++k) {
      const double azimuth = 2 * std::numbers::pi * (k + 0.5) / azimuths;
      ring += f(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle));
    }
    total += weight * ring * std::sin(angle);
  }
  return total * (to - from) / (3 * steps) * 2 * std::numbers::pi / azimuths;
}

template <class Function>
double integrate_hemisphere(Function&& f) {
  return integrate_sphere(f, 0, std::numbers::pi / 2);
}

}  // namespace nook::test
