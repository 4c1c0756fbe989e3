// Loads bytes as the checkpoint of a training and takes one step from it: nothing may crash, the parameters
// stay finite, and what loads is written and loaded again alike, whatever the bytes. Built for libFuzzer with
// clang; elsewhere checkpoint_fuzz_replay.cpp drives it.
#include <cmath>

#include "bakers/nnao/training.h"
#include "sdk/src/core/failure.h"
#include "tests/fuzz/checkpoint_recipe.h"
#include "tests/fuzz/container_input.h"

namespace {

using namespace nook::bake::nnao;
using nook::test::require;

void train_on(TrainingState state) {
  for (const float slope : {1.0f, -1e-3f, 0.0f}) {
    const std::vector<float> gradient(state.parameter.size(), slope);
    state.adam.step(state.parameter, gradient, 1e-3f);
  }
  for (const float parameter : state.parameter) require(std::isfinite(parameter));
}

void load(const std::vector<std::byte>& file, NetworkForm form) {
  try {
    const TrainingState state = read_checkpoint(file, nook::test::checkpoint_recipe, form);
    const TrainingState again = read_checkpoint(write_checkpoint(state, nook::test::checkpoint_recipe),
                                                nook::test::checkpoint_recipe, form);
    require(again.parameter == state.parameter && again.adam.mean == state.adam.mean);
    require(again.epochs_done == state.epochs_done && again.adam.steps == state.adam.steps);
    train_on(state);
  } catch (const nook::Failure&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const nook::test::ContainerInput input = nook::test::split_input(data, size);
  for (const NetworkForm form : {NetworkForm::horizon, NetworkForm::paper}) load(input.file, form);
  return 0;
}
