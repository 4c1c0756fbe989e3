#pragma once

namespace nook_samples::mannequin {

/// One sine wave for each loop, ahead by `lead` loops.
double swing(double phase, double lead = 0.0);
/// Rises to 1 and falls back between two phases, with a rest at the top of `hold` of the whole.
double pulse(double phase, double from, double to, double hold = 0.2);

}  // namespace nook_samples::mannequin
