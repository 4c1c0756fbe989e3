#include "samples/mannequin/phase_curves.h"

#include <cmath>
#include <numbers>

#include "samples/mannequin/ramp.h"

namespace nook_samples::mannequin {

double swing(double phase, double lead) {
  return std::sin(2.0 * std::numbers::pi * (phase + lead));
}

double pulse(double phase, double from, double to, double hold) {
  const double edge = 0.5 * (1.0 - hold) * (to - from);
  return ramp(phase, from, from + edge) * (1.0 - ramp(phase, to - edge, to));
}

}  // namespace nook_samples::mannequin
