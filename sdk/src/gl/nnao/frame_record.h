// A frame of a host as plain data that can be replayed elsewhere.
#pragma once

#include <nook/nook_nnao.h>

#include <span>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/nnao/recording.h"

namespace nook::gl {

// Draws a frame that passed check_frame into the pass's own texture, and reads it and the frame's inputs
// back. made_with: the pass's settings. network: its file. note may be null. Touches the state of a frame's
// users and of screen_reads. Throws Failure.
nnao::Recording record_frame(Device& device, NnaoPass& pass, const nook_nnao_desc& made_with,
                             std::span<const std::byte> network, const NnaoFrame& frame, const char* note);

}  // namespace nook::gl
