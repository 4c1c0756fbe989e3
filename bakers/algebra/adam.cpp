#include "bakers/algebra/adam.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nook::bake {

void Adam::step(std::span<float> parameters, std::span<const float> gradient, float rate) {
  constexpr float keep_mean = 0.9f, keep_square = 0.999f, epsilon = 1e-8f;
  constexpr std::size_t block = 1 << 15;
  ++steps;
  const double scale = std::sqrt(1 - std::pow(double(keep_square), double(steps))) /
                       (1 - std::pow(double(keep_mean), double(steps)));
  const float step_rate = float(rate * scale);
  tbb::parallel_for(std::size_t(0), (parameters.size() + block - 1) / block, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(parameters.size(), (b + 1) * block); ++i) {
      mean[i] = keep_mean * mean[i] + (1 - keep_mean) * gradient[i];
      square[i] = keep_square * square[i] + (1 - keep_square) * gradient[i] * gradient[i];
      parameters[i] -= step_rate * mean[i] / (std::sqrt(square[i]) + epsilon);
    }
  });
}

}  // namespace nook::bake
