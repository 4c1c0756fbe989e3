// A training state as a file, so that an interrupted training goes on to the same bits. A .nook container of
// the kind "NNCP" with the sections HEAD u64 fingerprint, u32 epochs done, u64 steps of Adam, and NUMB, for
// each parameter its value, mean gradient and mean squared gradient.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "bakers/nnao/training.h"
#include "sdk/src/core/container.h"

namespace nook::bake::nnao {

inline constexpr ContainerKind checkpoint_kind{four_letters("NNCP"), "training checkpoint", 1, 1};

// recipe: everything that the result depends on; a checkpoint fits no other.
std::vector<std::byte> write_checkpoint(const TrainingState& state, std::string_view recipe);

// Throws Failure(NOOK_ERROR_BAD_FILE), also where the recipe or the number of parameters is another.
TrainingState read_checkpoint(std::span<const std::byte> bytes, std::string_view recipe, NetworkForm form);

}  // namespace nook::bake::nnao
