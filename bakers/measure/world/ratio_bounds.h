// Computes confidence bounds for the ratio of two methods' errors. The ratio is uncertain because it depends
// on which poses were measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/raytrace/random.h"

namespace nook::measure {

struct RatioBounds {
  double low = 0, high = 0;
};

// Returns the 95 % bootstrap interval of the ratio of two sums. The bootstrap draws poses with replacement.
// `over` and `under` have one value per pose.
inline RatioBounds ratio_bounds(const std::vector<double>& over, const std::vector<double>& under,
                                std::size_t draws, std::uint64_t seed) {
  std::vector<double> ratio;
  bake::Random random(seed);
  for (std::size_t d = 0; d < draws; ++d) {
    double a = 0, b = 0;
    for (std::size_t i = 0; i < over.size(); ++i) {
      const std::uint32_t pose = random.below(std::uint32_t(over.size()));
      a += over[pose];
      b += under[pose];
    }
    ratio.push_back(b > 0 ? a / b : 0);
  }
  std::sort(ratio.begin(), ratio.end());
  const auto at = [&](double share) { return ratio[std::size_t(share * double(ratio.size() - 1))]; };
  return {at(0.025), at(0.975)};
}

}  // namespace nook::measure
