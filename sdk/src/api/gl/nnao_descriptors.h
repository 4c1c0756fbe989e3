// The descriptors of the screen-space pass: defaults and checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network.h"

namespace nook::api {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless max_width and max_height are valid maximum sizes of a
// screen pass. The message calls them desc.max_width and desc.max_height.
void check_max_size(std::int32_t max_width, std::int32_t max_height);

// Returns the caller's descriptor in this library's version, together with its debug descriptor. If a field
// is invalid, throws Failure(NOOK_ERROR_INVALID_ARGUMENT) with the name of the field.
gl::NnaoSettings checked_nnao_desc(const nook_nnao_desc* given);

// Returns the caller's descriptors of a frame in this library's version, unchecked.
gl::NnaoFrame read_nnao_frame(const nook_gl_frame_desc* frame, const nook_nnao_frame_desc* desc);

// Returns the bytes of the network file. If the host has passed no network, returns the embedded network.
std::span<const std::byte> network_bytes(const nook_nnao_desc& desc);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the descriptor needs a feature that networks of this form do
// not have.
void check_form(const nook_nnao_desc& desc, nnao::NetworkForm form);

}  // namespace nook::api
