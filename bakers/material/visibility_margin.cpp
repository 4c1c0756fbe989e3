#include "bakers/material/visibility_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nook::bake::material {

std::vector<float> margin_targets(std::span<const float> values, std::span<const float> decoded,
                                  float threshold) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const float value : values) nearest = std::min(nearest, std::abs(value - threshold));
  const float margin = 0.8f * nearest;
  std::vector<float> targets(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float side = values[i] > threshold ? 1.0f : -1.0f, most = 1.5f * std::abs(values[i] - threshold);
    const float reached = side * (decoded[i] - threshold);
    targets[i] = threshold + side * (reached >= margin ? std::min(reached, most) : 2 * margin - reached);
  }
  return targets;
}

}  // namespace nook::bake::material
