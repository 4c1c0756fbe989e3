// Independent random samples of functions on the sphere, and small helpers of the fits' tests.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/basis.h"
#include "sdk/src/probe/fit.h"

namespace nook::test {

struct Samples {
  std::vector<float> directions, radiance, weights;
  std::size_t size() const { return weights.size(); }
};

class Directions {
 public:
  explicit Directions(std::uint32_t seed, probe::Domain domain = probe::Domain::sphere)
      : random_(seed), lowest_(domain == probe::Domain::sphere ? -1.0 : 0.0) {}

  double uniform() { return double(random_()) / 4294967296.0; }
  Vec3 next() {
    const double z = lowest_ + (1 - lowest_) * uniform(), azimuth = 6.283185307179586 * uniform();
    const double r = std::sqrt(1 - z * z);
    return {float(r * std::cos(azimuth)), float(r * std::sin(azimuth)), float(z)};
  }

 private:
  std::mt19937 random_;
  double lowest_;
};

// f(direction) is RGB.
template <class Function>
Samples sample(std::uint32_t seed, std::size_t count, Function&& f,
               probe::Domain domain = probe::Domain::sphere) {
  Samples samples;
  Directions directions(seed, domain);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = directions.next(), v = f(d);
    samples.directions.insert(samples.directions.end(), {d.x, d.y, d.z});
    samples.radiance.insert(samples.radiance.end(), {v.x, v.y, v.z});
    samples.weights.push_back(1);
  }
  return samples;
}

inline void add(probe::Fit& fit, const Samples& samples, std::size_t first = 0,
                std::size_t count = SIZE_MAX) {
  count = std::min(count, samples.size() - first);
  fit.add_samples(samples.directions.data() + 3 * first, samples.radiance.data() + 3 * first,
                  samples.weights.data() + first, count);
}

using Coefficients = std::vector<Vec3>;

inline Coefficients read(probe::Fit& fit) {
  Coefficients coefficients(fit.basis().count);
  fit.read(coefficients);
  return coefficients;
}

// Integral over the domain of the squared difference of two fits, all channels: (a - b)^T G (a - b).
inline double squared_distance(const Vector<double>& gram, std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a.size(); ++k)
      sum += gram[i * a.size() + k] * double(dot(a[i] - b[i], a[k] - b[k]));
  return sum;
}
inline double squared_norm(const Vector<double>& gram, std::span<const Vec3> a) {
  return squared_distance(gram, a, Coefficients(a.size()));
}

inline double largest_difference(std::span<const Vec3> a, std::span<const Vec3> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, double(length(a[i] - b[i])));
  return largest;
}

}  // namespace nook::test
