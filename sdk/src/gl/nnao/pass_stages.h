// Describes the stages of the screen-space pass by shader texts and images, for hosts that do not use OpenGL.
#pragma once

#include <nook/experimental/nook_stages.h>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network.h"

namespace nook::gl {

struct StageText {
  explicit StageText(Memory* memory) : fragment(memory) {}

  const char* name = "";
  String fragment;
  nook_nnao_image output = NOOK_NNAO_IMAGE_TARGET;
  bool draws_viewport = false, reads_network = false;
  std::uint32_t input_count = 0;
  nook_nnao_image inputs[NOOK_NNAO_STAGE_MAX_INPUTS] = {};
};

struct PassStages {
  explicit PassStages(Memory* memory) : vertex(memory), stages(memory), network(memory) {}

  String vertex;
  Vector<StageText> stages;
  Vector<float> network;  // the contents of the uniform block; the last vec4 contains the number of
                          // directions as an integer
};

// The descriptor must have been checked, and the network must have the horizon form.
PassStages pass_stages(const NnaoSettings& desc, const nnao::Network& network, Memory* memory);

nook_nnao_image_info stage_image(const nook_nnao_desc& desc, nook_nnao_image image);

// Returns a bit mask of the stages to draw in a frame with this G-buffer AO. `count` is the number of stages
// of the pass.
std::uint32_t drawn_stages(std::size_t count, nook_gbuffer_ao layer);

// `frame` must have passed check_frame; `earlier` may be null. The result's drawn_stages is 0.
nook_nnao_frame_values frame_values(const nook_nnao_desc& desc, const NnaoFrame& frame,
                                    const NnaoFrame* earlier, std::uint32_t number, int layer);

}  // namespace nook::gl
