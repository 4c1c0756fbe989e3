// Trains the screen-space networks with Adam on minibatches of the data set. The learning rate falls to 0
// along a half cosine. The same seed gives the same bits on any number of threads, even if you stop and
// resume the training.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "bakers/algebra/adam.h"
#include "bakers/nnao/dataset.h"
#include "sdk/src/core/container.h"
#include "sdk/src/nnao/network.h"

namespace nook::bake::nnao {

using nook::nnao::Network;
using nook::nnao::NetworkForm;

struct TrainingSettings {
  NetworkForm form = NetworkForm::horizon;
  std::uint32_t epochs = 0;  // 0: the form's default
  std::uint32_t batch = 0;   // samples per step, a multiple of 16; 0: the form's default
  float rate = 0;            // initial learning rate; 0: the form's default
  std::uint64_t seed = 1;

  // Horizon form. The pass blurs its output, so the visible AO is the mean over the noise values of
  // neighbouring pixels. The loss is (1 - w) (bias of the mean)^2 + w (error of one pixel)^2, where w is
  // unblurred_weight. The first square is estimated by the product of the errors for two independent noise
  // values.
  float unblurred_weight = 0.3f;
  // The weight of a sample is 1 + dark_weight (1 - AO)^2. With equal weights, dark pixels would become too
  // bright: they are rare, and where the network cannot distinguish them from brighter pixels, it outputs the
  // mean of both.
  float dark_weight = 8;
  // Weight of the bent normal's squared error. It is multiplied by 1 - AO.
  float bent_weight = 0.1f;

  // Paper form, equation 2: the loss includes gamma times the mean of |theta|. We use the mean because the
  // sum over 15,500 parameters would exceed any error of an AO between 0 and 1.
  float gamma = 0.01f;
  float dropout = 0.5f;  // share of the first layer's inputs that each sample drops
};
TrainingSettings with_defaults(TrainingSettings settings);

// The state of a training run after some epochs. It is sufficient to resume the run.
struct TrainingState {
  explicit TrainingState(std::size_t parameters) : parameter(parameters), adam(parameters) {}

  std::uint32_t epochs_done = 0;
  std::vector<float> parameter;
  Adam adam;
};

struct TrainingProgress {
  std::uint32_t epoch = 0, epochs = 0;
  std::size_t steps_done = 0, steps = 0;  // steps of all epochs together
  double validation_mse = 0;              // error after the last finished epoch, at 64 taps; 0 before
};
// Called after every step. Return false to stop.
using OnTraining = std::function<bool(const TrainingProgress&)>;

// Called after every epoch.
using OnEpoch = std::function<void(const TrainingState&)>;

std::size_t parameter_count(NetworkForm form);
TrainingState start_training(const Dataset& data, const TrainingSettings& settings);
// Returns the network of a state. Its parameters are rounded as in a file.
Network network_of(const TrainingState& state, const Dataset& data, const TrainingSettings& settings);

// Continues from `state` to the last epoch. Throws Failure(NOOK_ERROR_CANCELLED) if `progress` returned
// false. In this case, `state` is the state after the last complete epoch.
Network train(const Dataset& data, const TrainingSettings& settings, TrainingState& state,
              const OnTraining& progress = {}, const OnEpoch& epoch_done = {});

// Saves a training state, so that an interrupted training can continue and end with the same bits. The file
// is a .nook container of the kind "NNCP" with two sections. HEAD stores u64 fingerprint, u32 finished epochs
// and u64 steps of Adam. NUMB stores the value, mean gradient and mean squared gradient of each parameter.

inline constexpr ContainerKind checkpoint_kind{four_letters("NNCP"), "training checkpoint", 1, 1};

// `recipe` must contain everything that the result depends on. A checkpoint can only be read with the same
// recipe.
std::vector<std::byte> write_checkpoint(const TrainingState& state, std::string_view recipe);

// Throws Failure(NOOK_ERROR_BAD_FILE) if the file is invalid, or if its recipe or number of parameters
// differs.
TrainingState read_checkpoint(std::span<const std::byte> bytes, std::string_view recipe, NetworkForm form);

}  // namespace nook::bake::nnao
