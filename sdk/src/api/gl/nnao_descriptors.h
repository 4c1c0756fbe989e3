// The descriptors of the screen-space pass: defaults and checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network.h"

namespace nook::api {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless desc.max_width and desc.max_height are sizes of a pass
// over the screen.
void check_max_size(std::int32_t max_width, std::int32_t max_height);

// Returns the caller's descriptor in this library's version, with its debug descriptor. Throws
// Failure(NOOK_ERROR_INVALID_ARGUMENT), naming the field, unless it is sound.
gl::NnaoSettings checked_nnao_desc(const nook_nnao_desc* given);

// Returns the caller's descriptors of a frame in this library's version, unchecked.
gl::NnaoFrame read_nnao_frame(const nook_gl_frame_desc* frame, const nook_nnao_frame_desc* desc);

// Returns the file of the network, which is the embedded one if the host gave none.
std::span<const std::byte> network_bytes(const nook_nnao_desc& desc);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the network's form lacks something that the descriptor
// needs.
void check_form(const nook_nnao_desc& desc, nnao::NetworkForm form);

}  // namespace nook::api
