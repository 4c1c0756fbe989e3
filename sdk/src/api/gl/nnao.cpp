#include <nook/experimental/nook_stages.h>
#include <nook/nook_nnao.h>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/gl/nnao_descriptors.h"
#include "sdk/src/api/nnao_recording_handle.h"
#include "sdk/src/gl/nnao/frame_record.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/taps.h"

using namespace nook;
using namespace nook::api;

// The OpenGL objects of a screen-space pass can outlive the handle nook_gl, because the pass holds a
// reference to the owner of nook_gl.
struct nook_nnao_s : RefCounted {
  nook_nnao_s(nook_gl_s* made_by, const gl::NnaoSettings& known, const nnao::Network& network)
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

  // Returns the users of the OpenGL state that reading the host's images touches.
  unsigned image_users() const {
    const unsigned samples = desc.views ? gl::screen_sample_layers : gl::screen_samples;
    return (desc.views ? unsigned{gl::screen_layers} : 0u) | (desc.depth_samples ? samples : 0u);
  }

  // Returns the bytes of the network file.
  std::span<const std::byte> network() const {
    return own_network.empty() ? nnao::default_network_file() : own_network;
  }

  nook_gl_s* gl;
  gl::NnaoSettings desc;  // the field `network` is not used
  nnao::NetworkForm form;
  Vector<std::byte> own_network;  // a copy of the host's network, for recordings; if empty, the embedded
                                  // network is used
  std::optional<gl::NnaoPass> pass;
};

namespace {

template <class Body>
nook_result with_pass(const char* function, nook_nnao pass, Body&& body) noexcept {
  return api::enter(function, [&] {
    need(pass, "pass");
    body();
  });
}

}  // namespace

nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes) {
  return api::enter("nook_nnao_memory", [&] {
    need(bytes, "bytes");
    const gl::NnaoSettings known = checked_nnao_desc(desc);
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
    const gl::NnaoSettings known = checked_nnao_desc(desc);
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

nook_result nook_nnao_render(nook_nnao pass, const nook_gl_frame_desc* frame,
                             const nook_nnao_frame_desc* desc) {
  return with_pass("nook_nnao_render", pass, [&] {
    gl::NnaoFrame known = read_nnao_frame(frame, desc);
    gl::check_frame(known, pass->desc);
    pass->gl->guarded(pass->users(), [&] { pass->pass->render(known); });
  });
}

nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info) {
  return with_pass("nook_nnao_describe", pass, [&] {
    pass->gl->device.need_current();
    nook_nnao_info known{};
    known.texture = pass->pass->ao_texture();
    known.texture_bytes = gl::texture_bytes(pass->desc, pass->form);
    known.taps = pass->desc.taps;
    known.half_resolution = pass->desc.half_resolution;
    known.blur = pass->desc.blur;
    known.horizon_form = pass->form == nnao::NetworkForm::horizon;
    known.compute = pass->pass->path() == NOOK_NNAO_PATH_COMPUTE;
    known.bent_normals = pass->desc.bent_normals;
    known.glsl = gl::screen_ao_glsl();
    write_info(info, known);
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
    write_info(timings, known);
  });
}

nook_result nook_nnao_record(nook_nnao pass, const nook_gl_frame_desc* frame,
                             const nook_nnao_frame_desc* desc, const char* note, nook_nnao_recording* out) {
  return with_pass("nook_nnao_record", pass, [&] {
    need(out, "out");
    *out = nullptr;
    const gl::NnaoFrame known = read_nnao_frame(frame, desc);
    gl::check_frame(known, pass->desc);
    if (pass->desc.views != 0 || pass->desc.depth_samples != 0)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "this pass reads texture arrays or multisample textures, which cannot be recorded (got desc.views "
          "%d and desc.depth_samples %d, need 0 for both); record one view with a pass for 2D textures",
          pass->desc.views, pass->desc.depth_samples);
    gl::Device& device = pass->gl->device;
    std::optional<nnao::Recording> recorded;
    device.need_alive();
    device.report_host_errors();
    pass->gl->guarded(pass->users() | gl::screen_reads, [&] {
      recorded.emplace(gl::record_frame(device, *pass->pass, pass->desc, pass->network(), known, note));
    });
    // The context owns the recording, so that the host can destroy the recording on any thread.
    *out = Owned<nook_nnao_recording_s>::make(device.memory, Ref<const Context>::share(&device.context),
                                              std::move(*recorded))
               .detach();
  });
}
