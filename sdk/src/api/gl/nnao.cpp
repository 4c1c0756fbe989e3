#include <nook/nook_nnao.h>

#include <cmath>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/nnao_recording_handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/nnao/frame_check.h"
#include "sdk/src/gl/nnao/frame_record.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/taps.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_nnao_s : RefCounted {
  nook_nnao_s(nook_gl_s* made_by, const nook_nnao_desc& known, const nnao::Network& network)
      : gl(made_by), desc(known), form(network.form), own_network(made_by->device.memory) {
    if (known.network) {
      const auto* const first = static_cast<const std::byte*>(known.network);
      own_network.assign(first, first + known.network_size);
    }
    desc.network = nullptr;
    gl->device.report_host_errors();
    gl::check_images_of(gl->device.gl, known);
    gl->guarded(gl::screen_creation_users(gl->device.gl) | image_users(),
                [&] { pass.emplace(gl->device, known, network); });
  }

  // Returns the users of the OpenGL state that a frame touches.
  unsigned users() const {
    return image_users() |
           (pass->path() == NOOK_NNAO_PATH_COMPUTE ? gl::screen | gl::screen_compute : gl::screen);
  }

  // Those of the host's images.
  unsigned image_users() const {
    return (desc.layers ? unsigned{gl::screen_layers} : 0u) |
           (desc.depth_samples ? unsigned{gl::screen_samples} : 0u);
  }

  // Returns the file of the network.
  std::span<const std::byte> network() const {
    return own_network.empty() ? nnao::default_network_file() : own_network;
  }

  nook_gl_s* gl;
  nook_nnao_desc desc;  // without network
  nnao::NetworkForm form;
  Vector<std::byte> own_network;  // for recordings; empty: the embedded one
  std::optional<gl::NnaoPass> pass;
};

namespace {

nook_nnao_desc default_desc() {
  nook_nnao_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.taps = nnao::default_taps;
  desc.blur = 1;
  desc.blur_sharpness = 16;
  return desc;
}
constexpr std::size_t first_desc = offsetof(nook_nnao_desc, network_size) + sizeof(std::size_t);

nook_nnao_frame_desc default_frame() {
  nook_nnao_frame_desc frame{};
  frame.struct_size = sizeof frame;
  frame.header_version = NOOK_VERSION;
  frame.normal_scale = 1;
  frame.normal_matrix[0] = frame.normal_matrix[4] = frame.normal_matrix[8] = 1;
  frame.intensity = frame.power = 1;
  frame.earlier_from_view[0] = frame.earlier_from_view[5] = frame.earlier_from_view[10] = 1;
  frame.motion_scale[0] = frame.motion_scale[1] = 1;
  frame.depth_log_scale = 1;
  return frame;
}
constexpr std::size_t first_frame = offsetof(nook_nnao_frame_desc, view) + sizeof(nook_nnao_view);
constexpr std::size_t first_info = offsetof(nook_nnao_info, horizon_form) + sizeof(std::int32_t);
constexpr std::size_t first_timings = offsetof(nook_nnao_timings, total) + sizeof(float);

void check_switch(const char* field, std::int32_t value) {
  if (value != 0 && value != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s is neither on nor off (got %d, need 0 or 1)", field,
                  value);
}

nook_nnao_desc checked(const nook_nnao_desc* given) {
  const nook_nnao_desc desc = read_descriptor(given, "nook_nnao_desc_init", first_desc, default_desc());
  constexpr int largest = 16384;
  if (desc.max_width < 1 || desc.max_height < 1 || desc.max_width > largest || desc.max_height > largest)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.max_width and desc.max_height are out of range (got %d x %d, need 1 x 1 to %d x %d)",
                  desc.max_width, desc.max_height, largest, largest);
  if (desc.taps < 0 || nnao::horizon_grid(static_cast<std::uint32_t>(desc.taps)).steps == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.taps is unknown (got %d, need 9, 16, 32, 64, 128 or 256)", desc.taps);
  check_switch("half_resolution", desc.half_resolution);
  if (desc.blur < 0 || desc.blur > 2)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.blur is out of range (got %d, need 0 to 2)", desc.blur);
  check_switch("timers", desc.timers);
  if (!(desc.blur_sharpness > 0) || !std::isfinite(desc.blur_sharpness))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.blur_sharpness is out of range (got %g, need more than 0)",
                  double(desc.blur_sharpness));
  if (desc.path < NOOK_NNAO_PATH_AUTOMATIC || desc.path > NOOK_NNAO_PATH_COMPUTE)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.path is unknown (got %d, need 0 to %d)", desc.path,
                  NOOK_NNAO_PATH_COMPUTE);
  check_switch("bent_normals", desc.bent_normals);
  if (desc.temporal_frames != 0 && (desc.temporal_frames < 2 || desc.temporal_frames > 64))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.temporal_frames is out of range (got %d, need 0, or 2 to 64)", desc.temporal_frames);
  if (desc.temporal_frames != 0 && desc.bent_normals)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.temporal_frames does not go with desc.bent_normals (got %d and 1); use one of them",
                  desc.temporal_frames);
  if (desc.depth_samples < 0 || desc.depth_samples > 16)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.depth_samples is out of range (got %d, need 0 to 16)",
                  desc.depth_samples);
  if (desc.depth_sample < NOOK_NNAO_SAMPLE_MEDIAN || desc.depth_sample > NOOK_NNAO_SAMPLE_NEAREST)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.depth_sample is unknown (got %d, need 0 to %d)",
                  desc.depth_sample, NOOK_NNAO_SAMPLE_NEAREST);
  if (desc.layers < 0 || desc.layers > gl::max_layers)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.layers is out of range (got %d, need 0 to %d)",
                  desc.layers, gl::max_layers);
  if (desc.layers != 0 && desc.depth_samples != 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.layers does not go with desc.depth_samples (got %d and %d); resolve depth to an array "
        "without samples",
        desc.layers, desc.depth_samples);
  if (!desc.network && desc.network_size != 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.network is NULL with desc.network_size %zu; give the bytes, or 0 for the embedded network",
        desc.network_size);
  return desc;
}

std::span<const std::byte> network_bytes(const nook_nnao_desc& desc) {
  if (!desc.network) return nnao::default_network_file();
  return {static_cast<const std::byte*>(desc.network), desc.network_size};
}

void check_form(const nook_nnao_desc& desc, nnao::NetworkForm form) {
  if (desc.bent_normals && form == nnao::NetworkForm::paper)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.bent_normals needs a network of the horizon form (got one of the paper's form); train "
        "one, or leave desc.network NULL");
}

template <class Body>
nook_result with_pass(const char* function, nook_nnao pass, Body&& body) noexcept {
  return api::enter(function, [&] {
    need(pass, "pass");
    body();
  });
}

}  // namespace

nook_result nook_nnao_desc_init(nook_nnao_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_nnao_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_desc, default_desc()); });
}

nook_result nook_nnao_desc_set_preset(nook_nnao_desc* desc, nook_nnao_preset preset) {
  return api::enter("nook_nnao_desc_set_preset", [&] {
    // A descriptor of an older or newer host is checked before it is written.
    read_descriptor(desc, "nook_nnao_desc_init", first_desc, default_desc());
    if (preset < NOOK_NNAO_PRESET_FAST || preset > NOOK_NNAO_PRESET_BEST)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "preset is unknown (got %d, need 0 to %d)", preset,
                    NOOK_NNAO_PRESET_BEST);
    desc->taps = preset == NOOK_NNAO_PRESET_BEST ? nnao::best_taps : nnao::default_taps;
    desc->half_resolution = preset == NOOK_NNAO_PRESET_FAST;
    desc->blur = 1;
  });
}

nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes) {
  return api::enter("nook_nnao_memory", [&] {
    need(bytes, "bytes");
    const nook_nnao_desc known = checked(desc);
    const nnao::NetworkForm form = nnao::network_form(network_bytes(known));
    check_form(known, form);
    *bytes = gl::texture_bytes(known, form);
  });
}

nook_result nook_nnao_create(nook_gl gl, const nook_nnao_desc* desc, nook_nnao* out) {
  return api::enter("nook_nnao_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    gl->device.need_alive();
    const nook_nnao_desc known = checked(desc);
    const nnao::Network network = nnao::read_network(network_bytes(known), gl->device.memory);
    check_form(known, network.form);
    *out =
        Owned<nook_nnao_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, known, network).detach();
  });
}

void nook_nnao_destroy(nook_nnao* pass) {
  if (!pass || !*pass) return;
  (*pass)->release();
  *pass = nullptr;
}

nook_result nook_nnao_frame_desc_init(nook_nnao_frame_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_nnao_frame_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_frame, default_frame()); });
}

nook_result nook_nnao_render(nook_nnao pass, const nook_nnao_frame_desc* frame) {
  return with_pass("nook_nnao_render", pass, [&] {
    const nook_nnao_frame_desc known =
        read_descriptor(frame, "nook_nnao_frame_desc_init", first_frame, default_frame());
    gl::check_frame(known, pass->desc);
    pass->gl->guarded(pass->users(), [&] { pass->pass->render(known); });
  });
}

nook_result nook_nnao_recheck(nook_nnao pass) {
  return with_pass("nook_nnao_recheck", pass, [&] { pass->pass->recheck(); });
}

nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info) {
  return with_pass("nook_nnao_describe", pass, [&] {
    nook_nnao_info known{};
    known.texture = pass->pass->ao_texture();
    known.texture_bytes = gl::texture_bytes(pass->desc, pass->form);
    known.taps = pass->desc.taps;
    known.horizon_form = pass->form == nnao::NetworkForm::horizon;
    known.path = pass->pass->path();
    known.bent_normals = pass->desc.bent_normals;
    known.glsl = gl::screen_ao_glsl();
    write_info(info, first_info, known);
  });
}

nook_result nook_nnao_read_timings(nook_nnao pass, nook_nnao_timings* timings) {
  return with_pass("nook_nnao_read_timings", pass, [&] {
    nook_nnao_timings known{};
    std::optional<gl::StageTimer::Milliseconds> stages;
    if (pass->pass->timer())
      pass->gl->guarded(gl::screen_timers, [&] { stages = pass->pass->timer()->newest(); });
    if (stages) {
      known.valid = 1;
      known.normals = (*stages)[0];
      known.occlusion = (*stages)[1];
      known.blur = (*stages)[2];
      known.resolve = (*stages)[3];
      known.total = known.normals + known.occlusion + known.blur + known.resolve;
    }
    write_info(timings, first_timings, known);
  });
}

nook_result nook_nnao_record(nook_nnao pass, const nook_nnao_frame_desc* frame, const char* note,
                             nook_nnao_recording* out) {
  return with_pass("nook_nnao_record", pass, [&] {
    need(out, "out");
    *out = nullptr;
    const nook_nnao_frame_desc known =
        read_descriptor(frame, "nook_nnao_frame_desc_init", first_frame, default_frame());
    gl::check_frame(known, pass->desc);
    if (pass->desc.layers != 0 || pass->desc.depth_samples != 0)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "the pass reads texture arrays or samples (desc.layers %d, desc.depth_samples %d; need 0); "
          "record one view with a pass of 2D textures",
          pass->desc.layers, pass->desc.depth_samples);
    gl::Device& device = pass->gl->device;
    std::optional<nnao::Recording> recorded;
    device.need_alive();
    device.report_host_errors();
    pass->gl->guarded(pass->users() | gl::screen_reads, [&] {
      recorded.emplace(gl::record_frame(device, *pass->pass, pass->desc, pass->network(), known, note));
    });
    // The owner is the context, so that a recording is destroyed on any thread.
    *out = Owned<nook_nnao_recording_s>::make(device.memory, Ref<const Context>::share(&device.context),
                                              std::move(*recorded))
               .detach();
  });
}
