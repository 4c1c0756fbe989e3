#include "bakers/nnao/training.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "bakers/nnao/forms.h"
#include "bakers/nnao/validation.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake::nnao {
namespace {

// Returns all points once, in an order that depends on the epoch.
std::vector<std::uint32_t> shuffled(std::size_t points, std::uint64_t seed) {
  std::vector<std::uint32_t> order(points);
  std::iota(order.begin(), order.end(), 0u);
  Random random(seed);
  for (std::size_t i = points; i > 1; --i) std::swap(order[i - 1], order[random.below(std::uint32_t(i))]);
  return order;
}

float rate_at(float rate, double share_done) {
  return rate * float(0.5 + 0.5 * std::cos(std::numbers::pi * share_done));
}

// The validation error during training uses about this many points.
constexpr std::size_t live_points = 8000;

}  // namespace

TrainingSettings with_defaults(TrainingSettings settings) {
  const bool paper = settings.form == NetworkForm::paper;
  if (settings.epochs == 0) settings.epochs = paper ? 12 : 40;
  if (settings.batch == 0) settings.batch = paper ? 64 : 256;
  if (settings.rate == 0) settings.rate = paper ? 1e-3f : 4e-3f;
  return settings;
}

std::size_t parameter_count(NetworkForm form) {
  return form == NetworkForm::paper ? paper_parameter_count() : horizon_parameter_count();
}

TrainingState start_training(const Dataset& data, const TrainingSettings& settings) {
  TrainingState state(parameter_count(settings.form));
  double mean = 0;
  for (const DataPoint& point : data.training) mean += double(point.ao);
  mean /= double(std::max<std::size_t>(1, data.training.size()));
  Random random(mix_bits(settings.seed ^ 0x5eed));
  if (settings.form == NetworkForm::paper)
    start_paper(state.parameter, float(mean), random);
  else
    start_horizon(state.parameter, float(mean), random);
  return state;
}

Network network_of(const TrainingState& state, const Dataset& data, const TrainingSettings& settings) {
  Network network;
  network.form = settings.form;
  if (settings.form == NetworkForm::paper)
    export_paper(state.parameter, paper_normalisation(data), network.paper);
  else
    export_horizon(state.parameter, network.horizon);
  return nook::nnao::read_network(nook::nnao::write_network(network));
}

Network train(const Dataset& data, const TrainingSettings& asked, TrainingState& state,
              const OnTraining& progress, const OnEpoch& epoch_done) {
  const TrainingSettings settings = with_defaults(asked);
  const std::size_t batches = data.training.size() / settings.batch;
  if (batches == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "too few training points for one minibatch (got %zu, need %u); use more views",
                  data.training.size(), settings.batch);
  const bool paper = settings.form == NetworkForm::paper;
  const PaperNormalisation normalisation = paper ? paper_normalisation(data) : PaperNormalisation{};
  TrainingProgress now{0, settings.epochs, 0, batches * settings.epochs, 0};
  std::vector<float> gradient(state.parameter.size());
  for (std::uint32_t epoch = state.epochs_done; epoch < settings.epochs; ++epoch) {
    now.epoch = epoch;
    // An interruption inside the epoch returns to this state.
    const TrainingState before = state;
    const std::uint64_t epoch_seed = mix_bits(settings.seed + mix_bits(epoch));
    const std::vector<std::uint32_t> order = shuffled(data.training.size(), epoch_seed);
    for (std::size_t b = 0; b < batches; ++b) {
      const std::span points = std::span(order).subspan(b * settings.batch, settings.batch);
      const std::uint64_t step_seed = mix_bits(epoch_seed ^ mix_bits(b + 1));
      if (paper)
        paper_step_gradient(data, normalisation, settings, state.parameter, points, step_seed, gradient);
      else
        horizon_step_gradient(data, settings, state.parameter, points, step_seed, gradient);
      now.steps_done = epoch * batches + b + 1;
      state.adam.step(state.parameter, gradient,
                      rate_at(settings.rate, double(now.steps_done) / double(now.steps)));
      if (progress && !progress(now)) {
        state = before;
        throw Failure(NOOK_ERROR_CANCELLED, "training was stopped after %u of %u epochs", epoch,
                      settings.epochs);
      }
    }
    state.epochs_done = epoch + 1;
    now.validation_mse =
        validation_mse(network_of(state, data, settings), data, 64, data.validation.size() / live_points + 1);
    if (epoch_done) epoch_done(state);
  }
  return network_of(state, data, settings);
}

}  // namespace nook::bake::nnao
