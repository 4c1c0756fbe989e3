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

// The maximum magnitude of a network's parameters. With this limit, the sums of an evaluation do not
// overflow.
inline constexpr float max_parameter = 1e4f;

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if a parameter is not finite or exceeds max_parameter.
std::vector<std::byte> write_network(const Network& network);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates no more memory than the filters and
// the recipe need.
Network read_network(std::span<const std::byte> bytes, Memory* memory = default_memory());

// Returns the form of the network in a file, without reading the rest of the file. Throws as read_network
// does.
NetworkForm network_form(std::span<const std::byte> bytes);

// Returns the network file that is compiled into the library, nnao/default_horizon.nook.
std::span<const std::byte> default_network_file();

}  // namespace nook::nnao
