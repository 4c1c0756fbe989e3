// Fits both layers together by mini-batches of poses with Adam: every parameter at once, on the clamped error
// that is reported.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/character/fit_state.h"

namespace nook::bake {

struct MiniBatchSettings {
  std::size_t steps = 10000;
  std::uint64_t seed = 1;
  float rate = 1;            // factor of all learning rates
  float final_rate = 0.02f;  // share of the rate at the last step (cosine decay)
  float warmup = 0.02f;      // share of the steps with a rising rate
};

// Called now and then with the number of finished steps. Return false to stop the fit after that step.
using StepProgress = std::function<bool(std::size_t step)>;

// Poses per batch. Each has one SIMD lane in the linear layer.
inline constexpr std::size_t batch_poses = 16;

// Fits the first set.fitted() poses. Work is cut into a fixed number of parts whose results are added in
// order, so that the same seed gives the same bits on any number of threads.
void fit_mini_batches(FitState& state, const TrainingSet& set, const MiniBatchSettings& settings,
                      const StepProgress& progress = {});

}  // namespace nook::bake
