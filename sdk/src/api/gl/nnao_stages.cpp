#include <nook/nook_nnao_stages.h>

#include <algorithm>
#include <iterator>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/nnao_descriptors.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/core/ref.h"
#include "sdk/src/gl/nnao/frame_check.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/stages.h"
#include "sdk/src/nnao/network_file.h"

using namespace nook;
using namespace nook::api;

struct nook_nnao_stages_s : RefCounted {
  nook_nnao_stages_s(const nook_nnao_desc& known, const nnao::Network& network, Memory* memory)
      : desc(known), pass(gl::pass_stages(known, network, memory)) {
    desc.network = desc.next = nullptr;
  }

  nook_nnao_desc desc;  // without network
  const gl::PassStages pass;
};

namespace {

constexpr std::size_t first_info = offsetof(nook_nnao_stages_info, reserved) + sizeof(std::uint32_t);
constexpr std::size_t first_image = offsetof(nook_nnao_image_info, height) + sizeof(std::int32_t);
constexpr std::size_t first_stage =
    offsetof(nook_nnao_stage_info, inputs) + sizeof(nook_nnao_image) * NOOK_NNAO_STAGE_MAX_INPUTS;
constexpr std::size_t first_values =
    offsetof(nook_nnao_frame_values, constants) + sizeof(float) * NOOK_NNAO_STAGE_CONSTANTS;

// The frame with what the host's graphics interface takes the place of: textures and target.
nook_nnao_frame_desc checked_frame(const nook_nnao_frame_desc* given, const nook_nnao_desc& desc) {
  nook_nnao_frame_desc frame =
      read_descriptor(given, "nook_nnao_frame_desc_init", first_nnao_frame, default_nnao_frame());
  const nook_nnao_blend blend = frame.blend;
  frame.depth_texture = 1;
  frame.layer_texture = 1;
  frame.target = NOOK_NNAO_TARGET_OWN;
  frame.blend = NOOK_NNAO_WRITE;
  gl::check_frame(frame, desc);
  if (blend != NOOK_NNAO_WRITE && blend != NOOK_NNAO_MULTIPLY)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.blend is unknown (got %d, need 0 or 1)", blend);
  if (frame.view == NOOK_NNAO_VIEW_RAW && desc.temporal_frames)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.view %d does not go with desc.temporal_frames %d here; read NOOK_NNAO_IMAGE_AO",
                  frame.view, desc.temporal_frames);
  frame.blend = blend;
  return frame;
}

}  // namespace

nook_result nook_nnao_stages_create(nook_context context, const nook_nnao_desc* desc, nook_nnao_stages* out) {
  return enter("nook_nnao_stages_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_nnao_desc known = checked_nnao_desc(desc);
    const nnao::Network network = nnao::read_network(network_bytes(known), context->memory());
    if (network.form != nnao::NetworkForm::horizon)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.network has the paper's form (need the horizon form); train one, or leave "
                    "desc.network NULL");
    *out = Owned<nook_nnao_stages_s>::make(context->memory(), Ref<nook_context_s>::share(context), known,
                                           network, context->memory())
               .detach();
  });
}

void nook_nnao_stages_destroy(nook_nnao_stages* stages) {
  if (!stages || !*stages) return;
  (*stages)->release();
  *stages = nullptr;
}

nook_result nook_nnao_stages_describe(nook_nnao_stages stages, nook_nnao_stages_info* info) {
  return enter("nook_nnao_stages_describe", [&] {
    need(stages, "stages");
    nook_nnao_stages_info known{};
    known.stage_count = std::uint32_t(stages->pass.stages.size());
    known.vertex_shader = stages->pass.vertex.c_str();
    known.network = stages->pass.network.data();
    known.network_bytes = std::uint32_t(stages->pass.network.size() * sizeof(float));
    write_info(info, first_info, known);
  });
}

nook_result nook_nnao_stages_image(nook_nnao_stages stages, nook_nnao_image image,
                                   nook_nnao_image_info* info) {
  return enter("nook_nnao_stages_image", [&] {
    need(stages, "stages");
    if (image < 0 || image >= NOOK_NNAO_IMAGE_COUNT)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "image is unknown (got %d, need 0 to %d)", image,
                    NOOK_NNAO_IMAGE_COUNT - 1);
    write_info(info, first_image, gl::stage_image(stages->desc, image));
  });
}

nook_result nook_nnao_stages_stage(nook_nnao_stages stages, uint32_t index, nook_nnao_stage_info* info) {
  return enter("nook_nnao_stages_stage", [&] {
    need(stages, "stages");
    if (index >= stages->pass.stages.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "index is out of range (got %u, need less than %zu)", index,
                    stages->pass.stages.size());
    const gl::StageText& stage = stages->pass.stages[index];
    nook_nnao_stage_info known{};
    known.output = stage.output;
    known.name = stage.name;
    known.fragment_shader = stage.fragment.c_str();
    known.draws_viewport = stage.draws_viewport;
    known.reads_network = stage.reads_network;
    known.input_count = stage.input_count;
    std::copy(std::begin(stage.inputs), std::end(stage.inputs), known.inputs);
    write_info(info, first_stage, known);
  });
}

nook_result nook_nnao_stages_frame(nook_nnao_stages stages, const nook_nnao_frame_desc* frame,
                                   const nook_nnao_frame_desc* earlier, uint32_t number, uint32_t layer,
                                   nook_nnao_frame_values* values) {
  return enter("nook_nnao_stages_frame", [&] {
    need(stages, "stages");
    const nook_nnao_desc& desc = stages->desc;
    if (layer >= std::uint32_t(gl::drawn_layers(desc)))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "layer is out of range (got %u, need less than %d)", layer,
                    gl::drawn_layers(desc));
    const nook_nnao_frame_desc known = checked_frame(frame, desc);
    nook_nnao_frame_desc before{};
    if (earlier) before = checked_frame(earlier, desc);
    nook_nnao_frame_values computed =
        gl::frame_values(desc, known, earlier ? &before : nullptr, number, int(layer));
    computed.drawn_stages = gl::drawn_stages(stages->pass.stages.size(), known.layer);
    write_info(values, first_values, computed);
  });
}
