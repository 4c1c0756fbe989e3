// A training state as a file, so that an interrupted training continues and ends with the same bits. The file
// is a .nook container of the kind "NNCP" with two sections: HEAD has u64 fingerprint, u32 finished epochs,
// u64 steps of Adam, and NUMB has value, mean gradient and mean squared gradient of each parameter.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "bakers/nnao/training.h"
#include "sdk/src/core/container.h"

namespace nook::bake::nnao {

inline constexpr ContainerKind checkpoint_kind{four_letters("NNCP"), "training checkpoint", 1, 1};

// recipe contains everything that the result depends on; a checkpoint fits no other recipe.
std::vector<std::byte> write_checkpoint(const TrainingState& state, std::string_view recipe);

// Throws Failure(NOOK_ERROR_BAD_FILE), also if the recipe or the number of parameters differs.
TrainingState read_checkpoint(std::span<const std::byte> bytes, std::string_view recipe, NetworkForm form);

}  // namespace nook::bake::nnao
