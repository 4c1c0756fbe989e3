#include "bakers/nnao/adam.h"

#include <cmath>

namespace nook::bake::nnao {

void Adam::step(std::span<float> parameters, std::span<const float> gradient, float rate) {
  constexpr float keep_mean = 0.9f, keep_square = 0.999f, epsilon = 1e-8f;
  ++steps;
  const double scale = std::sqrt(1 - std::pow(double(keep_square), double(steps))) /
                       (1 - std::pow(double(keep_mean), double(steps)));
  const float step_rate = float(rate * scale);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    mean[i] = keep_mean * mean[i] + (1 - keep_mean) * gradient[i];
    square[i] = keep_square * square[i] + (1 - keep_square) * gradient[i] * gradient[i];
    parameters[i] -= step_rate * mean[i] / (std::sqrt(square[i]) + epsilon);
  }
}

}  // namespace nook::bake::nnao
