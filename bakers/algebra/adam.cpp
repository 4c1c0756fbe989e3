#include "bakers/algebra/adam.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace nook::bake {

void Adam::step(std::span<float> parameters, std::span<const float> gradient, float rate) {
  constexpr float keep_mean = 0.9f, keep_square = 0.999f, epsilon = 1e-8f;
  constexpr std::size_t block = 1 << 15;
  using Numbers = Eigen::Map<Eigen::ArrayXf>;
  ++steps;
  const double scale = std::sqrt(1 - std::pow(double(keep_square), double(steps))) /
                       (1 - std::pow(double(keep_mean), double(steps)));
  const float step_rate = float(rate * scale);
  tbb::parallel_for(std::size_t(0), (parameters.size() + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block;
    const auto count = Eigen::Index(std::min(block, parameters.size() - first));
    const Eigen::Map<const Eigen::ArrayXf> slope(&gradient[first], count);
    Numbers number(&parameters[first], count), m(&mean[first], count), s(&square[first], count);
    m = keep_mean * m + (1 - keep_mean) * slope;
    s = keep_square * s + (1 - keep_square) * slope * slope;
    number -= step_rate * m / (s.sqrt() + epsilon);
  });
}

}  // namespace nook::bake
