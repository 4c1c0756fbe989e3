// Networks as .nook files. Version 1 of the kind "NNAO" has the sections
//   HEAD  u8 form, then the form's fixed sizes (u16: paper grid_size, tap_inputs, units; horizon revision,
//         tap_inputs, units)
//   FILT  the paper's filters, half floats (paper form only)
//   LAYR  the layers in the order of layers.h, 32-bit floats
//   RECP  recipe
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/nnao/network.h"

namespace nook::nnao {

inline constexpr ContainerKind network_kind{four_letters("NNAO"), "screen-space network", 1, 1};

// The maximum magnitude of a network's numbers, so that no sum of the evaluation overflows.
inline constexpr float max_parameter = 1e4f;

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if a number is not finite or too large.
std::vector<std::byte> write_network(const Network& network);

// Hostile bytes are safe, also with a correct checksum: the call throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates no more than the filters and the recipe.
Network read_network(std::span<const std::byte> bytes, Memory* memory = default_memory());

// Returns the form of a network without reading the rest of it. Throws as read_network does.
NetworkForm network_form(std::span<const std::byte> bytes);

// Returns the network file that is compiled into the library, nnao/default_horizon.nook.
std::span<const std::byte> default_network_file();

}  // namespace nook::nnao
