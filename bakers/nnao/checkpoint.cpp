#include "bakers/nnao/checkpoint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cmath>

#include "sdk/src/core/failure.h"

namespace nook::bake::nnao {
namespace {

std::uint64_t fingerprint(std::string_view recipe) {
  return XXH64(recipe.data(), recipe.size(), 0);
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
                  "the checkpoint is of a training with other settings; remove it, or use those settings");
  TrainingState state(parameter_count(form));
  state.epochs_done = head.u32();
  state.adam.steps = head.u64();
  head.check_end();
  for (std::size_t i = 0; i < state.parameter.size(); ++i)
    for (float* value : {&state.parameter[i], &state.adam.mean[i], &state.adam.square[i]}) {
      *value = numbers.f32();
      if (!std::isfinite(*value))
        throw Failure(NOOK_ERROR_BAD_FILE, "the checkpoint holds a number that is not finite; remove it");
    }
  numbers.check_end();
  return state;
}

}  // namespace nook::bake::nnao
