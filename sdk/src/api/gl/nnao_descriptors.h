// The descriptors of the screen-space pass: defaults and checks.
#pragma once

#include <nook/nook_nnao.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/nnao/network.h"

namespace nook::api {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless desc.max_width and desc.max_height are sizes of a pass
// over the screen.
void check_max_size(std::int32_t max_width, std::int32_t max_height);

// Returns the caller's descriptor in this library's version. Throws
// Failure(NOOK_ERROR_INVALID_ARGUMENT), naming the field, unless it is sound.
nook_nnao_desc checked_nnao_desc(const nook_nnao_desc* given);

// Returns the file of the network, which is the embedded one if the host gave none.
std::span<const std::byte> network_bytes(const nook_nnao_desc& desc);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the network's form lacks something that the descriptor
// needs.
void check_form(const nook_nnao_desc& desc, nnao::NetworkForm form);

}  // namespace nook::api
