#pragma once

#include <algorithm>

namespace nook_samples::mannequin {

/// Rises smoothly from 0 at `from` to 1 at `to`, and stays there on either side.
inline double ramp(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace nook_samples::mannequin
