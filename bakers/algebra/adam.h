// Adam: Kingma and Ba 2014.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake {

struct Adam {
  explicit Adam(std::size_t parameters) : mean(parameters), square(parameters) {}

  // Takes one step against the gradient. Runs in parallel if there are many parameters.
  void step(std::span<float> parameters, std::span<const float> gradient, float rate);

  std::vector<float> mean, square;
  std::uint64_t steps = 0;
};

}  // namespace nook::bake
