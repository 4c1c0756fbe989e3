// Fits all parameters of both layers together, with Adam on mini-batches of poses. The loss is the clamped
// error, the same error that is reported.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/character/fit_state.h"

namespace nook::bake {

struct MiniBatchSettings {
  std::size_t steps = 10000;
  std::uint64_t seed = 1;
  float rate = 1;            // factor for all learning rates
  float final_rate = 0.02f;  // rate at the last step as a share of the full rate (cosine decay)
  float warmup = 0.02f;      // share of the steps with a rising rate
};

// Called from time to time with the number of finished steps. Return false to stop the fit after that step.
using StepProgress = std::function<bool(std::size_t step)>;

// Poses per batch. Each has one SIMD lane in the linear layer.
inline constexpr std::size_t batch_poses = 16;

// Fits the first set.fitted() poses. The work is split into a fixed number of parts, and the results of the
// parts are added in order. So the same seed gives the same bits with any number of threads.
void fit_mini_batches(FitState& state, const TrainingSet& set, const MiniBatchSettings& settings,
                      const StepProgress& progress = {});

}  // namespace nook::bake
