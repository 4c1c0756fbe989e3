#include "bakers/nnao/checkpoint.h"

#include <cmath>
#include <span>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake::nnao {
namespace {

std::uint64_t fingerprint(std::string_view recipe) {
  return hash64(std::as_bytes(std::span(recipe)));
}

// Far above any training; each of these steps takes its time.
constexpr std::uint64_t max_steps = std::uint64_t{1} << 48;

// Returns whether a training can have left these numbers, so that the next step is finite. Adam's decay rates
// make the square of the mean gradient at most 53 times the mean squared gradient (by Cauchy and Schwarz);
// squares of gradients below 1e-18 vanish.
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
                  "the checkpoint is of a training with other settings; remove it, or use those settings");
  TrainingState state(parameter_count(form));
  state.epochs_done = head.u32();
  state.adam.steps = head.u64();
  head.check_end();
  if (state.adam.steps > max_steps)
    throw Failure(
        NOOK_ERROR_BAD_FILE, "the checkpoint says that %llu steps were taken (need at most %llu); remove it",
        static_cast<unsigned long long>(state.adam.steps), static_cast<unsigned long long>(max_steps));
  for (std::size_t i = 0; i < state.parameter.size(); ++i) {
    for (float* value : {&state.parameter[i], &state.adam.mean[i], &state.adam.square[i]})
      *value = numbers.f32();
    if (!is_reachable(state.parameter[i], state.adam.mean[i], state.adam.square[i]))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "parameter %zu of the checkpoint is no number that training leaves (got %g, its mean "
                    "gradient %g, mean squared gradient %g); remove it",
                    i, double(state.parameter[i]), double(state.adam.mean[i]), double(state.adam.square[i]));
  }
  numbers.check_end();
  return state;
}

}  // namespace nook::bake::nnao
