#include "bakers/nnao/training.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "bakers/nnao/forms.h"
#include "bakers/nnao/validation.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake::nnao {
namespace {

// Returns the indices of all points in a random order, which depends on the seed of the epoch.
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

// The number of points for the validation error during training (approximate).
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
    start_horizon(state.parameter, random);
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

namespace {

// A training run in progress. A batch depends only on the epoch and the batch index, not on the state.
struct Trainer {
  const Dataset& data;
  const TrainingSettings& settings;
  bool paper = settings.form == NetworkForm::paper;
  PaperNormalisation normalisation = paper ? paper_normalisation(data) : PaperNormalisation{};
  std::vector<float> gradient = std::vector<float>(parameter_count(settings.form));

  std::uint64_t epoch_seed(std::uint32_t epoch) const { return mix_bits(settings.seed + mix_bits(epoch)); }

  // Takes one step. Returns the loss of the batch before the step.
  double step(TrainingState& state, std::uint32_t epoch, std::span<const std::uint32_t> order,
              std::size_t batch, float rate) {
    const std::span points = order.subspan(batch * settings.batch, settings.batch);
    const std::uint64_t seed = mix_bits(epoch_seed(epoch) ^ mix_bits(batch + 1));
    const double loss =
        paper ? paper_step_gradient(data, normalisation, settings, state.parameter, points, seed, gradient)
              : horizon_step_gradient(data, settings, state.parameter, points, seed, gradient);
    state.adam.step(state.parameter, gradient, rate);
    if (!paper) constrain_horizon(state.parameter);
    return loss;
  }
};

// A small network depends on its initial values, because some of them leave units without effect. So we start
// with several sets of values. Each round trains the remaining sets on the same batches, and keeps the best
// quarter.
constexpr std::size_t first_starts = 16, last_starts = 4;

std::size_t steps_of_starts(std::size_t length) {
  std::size_t steps = 0;
  for (std::size_t starts = first_starts; starts >= last_starts; starts /= 4, length *= 4)
    steps += starts * length;
  return steps;
}

// `length` is the number of steps that each start takes in the first round. step_done is called after each
// step.
TrainingState best_start(Trainer& trainer, std::size_t length, std::size_t batches,
                         const std::function<void()>& step_done) {
  const std::vector<std::uint32_t> order = shuffled(trainer.data.training.size(), trainer.epoch_seed(0));
  std::vector<std::pair<double, TrainingState>> starts;
  for (std::size_t i = 0; i < first_starts; ++i) {
    TrainingSettings settings = trainer.settings;
    settings.seed = mix_bits(settings.seed + i);
    starts.emplace_back(0.0, start_training(trainer.data, settings));
  }
  std::size_t first = 0;
  for (; starts.size() >= last_starts; first += length, length *= 4) {
    for (auto& [loss, state] : starts) {
      loss = 0;
      for (std::size_t b = 0; b < length; ++b) {
        const double of_batch = trainer.step(state, 0, order, (first + b) % batches, trainer.settings.rate);
        if (2 * b >= length) loss += of_batch;
        step_done();
      }
    }
    std::ranges::stable_sort(starts, {}, [](const auto& start) { return start.first; });
    starts.erase(starts.begin() + std::ptrdiff_t(starts.size() / 4), starts.end());
  }
  return std::move(starts.front().second);
}

}  // namespace

Network train(const Dataset& data, const TrainingSettings& asked, TrainingState& state,
              const OnTraining& progress, const OnEpoch& epoch_done) {
  const TrainingSettings settings = with_defaults(asked);
  const std::size_t batches = data.training.size() / settings.batch;
  if (batches == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "too few training points for one minibatch (got %zu, need %u); use more views",
                  data.training.size(), settings.batch);
  Trainer trainer{data, settings};
  const std::size_t epoch_steps = batches * settings.epochs,
                    start_length = std::min(epoch_steps / 200, batches) + 1;
  const std::size_t start_steps = trainer.paper ? 0 : steps_of_starts(start_length);
  TrainingProgress now{0, settings.epochs, 0, start_steps + epoch_steps, 0};
  const auto check_progress = [&] {
    if (progress && !progress(now))
      throw Failure(NOOK_ERROR_CANCELLED, "training was stopped after %u of %u epochs", now.epoch,
                    settings.epochs);
  };
  if (!trainer.paper && state.epochs_done == 0)
    state = best_start(trainer, start_length, batches, [&] {
      ++now.steps_done;
      check_progress();
    });
  for (std::uint32_t epoch = state.epochs_done; epoch < settings.epochs; ++epoch) {
    now.epoch = epoch;
    // If the epoch is interrupted, training returns to this state.
    const TrainingState before = state;
    const std::vector<std::uint32_t> order = shuffled(data.training.size(), trainer.epoch_seed(epoch));
    for (std::size_t b = 0; b < batches; ++b) {
      const std::size_t done = epoch * batches + b + 1;
      trainer.step(state, epoch, order, b, rate_at(settings.rate, double(done) / double(epoch_steps)));
      now.steps_done = start_steps + done;
      try {
        check_progress();
      } catch (const Failure&) {
        state = before;
        throw;
      }
    }
    state.epochs_done = epoch + 1;
    now.validation_mse =
        validation_mse(network_of(state, data, settings), data, 64, data.validation.size() / live_points + 1);
    if (epoch_done) epoch_done(state);
  }
  return network_of(state, data, settings);
}

namespace {

std::uint64_t fingerprint(std::string_view recipe) {
  return hash64(std::as_bytes(std::span(recipe)));
}

// Far more steps than any training could take.
constexpr std::uint64_t max_steps = std::uint64_t{1} << 48;

// Returns true if training can produce these values. Then the next step is finite. With Adam's decay rates,
// the square of the mean gradient is at most 53 times the mean squared gradient (Cauchy-Schwarz inequality).
// If a gradient is below 1e-18, its square underflows to 0.
bool is_reachable(float parameter, float mean, float square) {
  return std::abs(parameter) <= nook::nnao::max_parameter && std::isfinite(square) && square >= 0 &&
         std::abs(mean) <= 8 * std::sqrt(square) + 1e-18f;
}

}  // namespace

std::vector<std::byte> write_checkpoint(const TrainingState& state, std::string_view recipe) {
  ByteWriter head, numbers;
  head.u64(fingerprint(recipe));
  head.u32(state.epochs_done);
  head.u64(state.adam.steps);
  for (std::size_t i = 0; i < state.parameter.size(); ++i)
    for (const float value : {state.parameter[i], state.adam.mean[i], state.adam.square[i]})
      numbers.f32(value);
  const ContainerSection sections[] = {{four_letters("HEAD"), head.bytes()},
                                       {four_letters("NUMB"), numbers.bytes()}};
  return write_container(checkpoint_kind, sections);
}

TrainingState read_checkpoint(std::span<const std::byte> bytes, std::string_view recipe, NetworkForm form) {
  const Container file(bytes, checkpoint_kind);
  ByteReader head = file.section("HEAD"), numbers = file.section("NUMB");
  if (head.u64() != fingerprint(recipe))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the checkpoint belongs to a training with other settings; remove the checkpoint, or use "
                  "the settings of that training");
  TrainingState state(parameter_count(form));
  state.epochs_done = head.u32();
  state.adam.steps = head.u64();
  head.check_end();
  if (state.adam.steps > max_steps)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the checkpoint says that %llu steps were taken (need at most %llu); remove the checkpoint",
                  static_cast<unsigned long long>(state.adam.steps),
                  static_cast<unsigned long long>(max_steps));
  for (std::size_t i = 0; i < state.parameter.size(); ++i) {
    for (float* value : {&state.parameter[i], &state.adam.mean[i], &state.adam.square[i]})
      *value = numbers.f32();
    if (!is_reachable(state.parameter[i], state.adam.mean[i], state.adam.square[i]))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "parameter %zu of the checkpoint has values that training cannot produce (got %g with "
                    "mean gradient %g and mean squared gradient %g); remove the checkpoint",
                    i, double(state.parameter[i]), double(state.adam.mean[i]), double(state.adam.square[i]));
  }
  numbers.check_end();
  return state;
}

}  // namespace nook::bake::nnao
