#include <nook/experimental/nook_stages.h>

#include <algorithm>
#include <iterator>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/nnao_descriptors.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/ref.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass_stages.h"
#include "sdk/src/nnao/network_file.h"

using namespace nook;
using namespace nook::api;

struct nook_nnao_stages_s : RefCounted {
  nook_nnao_stages_s(const gl::NnaoSettings& known, const nnao::Network& network, Memory* memory)
      : desc(known), pass(gl::pass_stages(known, network, memory)) {
    desc.network = nullptr;
  }

  gl::NnaoSettings desc;  // the field `network` is not used
  const gl::PassStages pass;
};

namespace {

// Returns the checked frame, without textures and target. Hosts of the stage interface bind textures and
// target with their own graphics API.
gl::NnaoFrame checked_frame(const nook_gl_frame_desc* given, const nook_nnao_frame_desc* settings,
                            const nook_nnao_desc& desc) {
  gl::NnaoFrame frame = read_nnao_frame(given, settings);
  const nook_blend blend = frame.blend;
  frame.depth_texture = 1;
  frame.gbuffer_ao_texture = 1;
  frame.target = NOOK_TARGET_OWN;
  frame.blend = NOOK_BLEND_WRITE;
  gl::check_frame(frame, desc);
  if (blend != NOOK_BLEND_WRITE && blend != NOOK_BLEND_MULTIPLY)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.blend is unknown (got %d, need 0 or 1)", blend);
  if (frame.show == NOOK_NNAO_VIEW_RAW && desc.max_history_frames)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "debug.show %d is not available if desc.max_history_frames is not 0 (got %d); read "
                  "NOOK_NNAO_IMAGE_AO instead",
                  frame.show, desc.max_history_frames);
  frame.blend = blend;
  // The format of the host's normal texture is not known here. A normal_bias other than 0 is only useful for
  // formats with normalised integers, so it tells the kind of format.
  frame.normalised_normals = frame.normal_bias != 0;
  return frame;
}

}  // namespace

nook_result nook_nnao_stages_create(nook_context context, const nook_nnao_desc* desc, nook_nnao_stages* out) {
  return enter("nook_nnao_stages_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const gl::NnaoSettings known = checked_nnao_desc(desc);
    const nnao::Network network = nnao::read_network(network_bytes(known), context->memory());
    if (network.form != nnao::NetworkForm::horizon)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.network has the paper's form (need the horizon form); train a network of the "
                    "horizon form, or leave desc.network NULL");
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
    known.taps = stages->desc.taps;
    known.half_resolution = stages->desc.half_resolution;
    known.blur = stages->desc.blur;
    write_info(info, known);
  });
}

nook_result nook_nnao_stages_describe_image(nook_nnao_stages stages, nook_nnao_image image,
                                            nook_nnao_image_info* info) {
  return enter("nook_nnao_stages_describe_image", [&] {
    need(stages, "stages");
    check_known("image", image, NOOK_NNAO_IMAGE_COUNT - 1);
    write_info(info, gl::stage_image(stages->desc, image));
  });
}

nook_result nook_nnao_stages_describe_stage(nook_nnao_stages stages, uint32_t index,
                                            nook_nnao_stage_info* info) {
  return enter("nook_nnao_stages_describe_stage", [&] {
    need(stages, "stages");
    check_index("index", index, stages->pass.stages.size());
    const gl::StageText& stage = stages->pass.stages[index];
    nook_nnao_stage_info known{};
    known.output = stage.output;
    known.name = stage.name;
    known.fragment_shader = stage.fragment.c_str();
    known.draws_viewport = stage.draws_viewport;
    known.reads_network = stage.reads_network;
    known.input_count = stage.input_count;
    std::copy(std::begin(stage.inputs), std::end(stage.inputs), known.inputs);
    write_info(info, known);
  });
}

nook_result nook_nnao_stages_frame(nook_nnao_stages stages, const nook_gl_frame_desc* frame,
                                   const nook_nnao_frame_desc* desc, const nook_gl_frame_desc* earlier,
                                   uint32_t number, uint32_t view, nook_nnao_frame_values* values) {
  return enter("nook_nnao_stages_frame", [&] {
    need(stages, "stages");
    const nook_nnao_desc& pass = stages->desc;
    check_index("view", view, std::size_t(gl::drawn_layers(pass)));
    const gl::NnaoFrame known = checked_frame(frame, desc, pass);
    gl::NnaoFrame before{};
    if (earlier) before = checked_frame(earlier, desc, pass);
    nook_nnao_frame_values computed =
        gl::frame_values(pass, known, earlier ? &before : nullptr, number, int(view));
    computed.drawn_stages = gl::drawn_stages(stages->pass.stages.size(), known.gbuffer_ao);
    write_info(values, computed);
  });
}
