#include <nook/experimental/nook_transfer.h>

#include <algorithm>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/transfer/transfer_textures.h"
#include "sdk/src/transfer/lit_rows.h"
#include "sdk/src/transfer/transfer_check.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner. It has
// either the vectors of vertices or the paper's form.
struct nook_gl_transfer_s : RefCounted {
  nook_gl_transfer_s(nook_gl_s* made_by, std::uint32_t light_modes, std::uint32_t vertices) : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(gl::probe_users(gl->device.gl), [&] { texture.emplace(gl->device, light_modes, vertices); });
  }
  nook_gl_transfer_s(nook_gl_s* made_by, nook_transfer transfer, nook_transfer_response under)
      : gl(made_by),
        baked(Ref<nook_transfer_s>::share(transfer)),
        response(Ref<nook_transfer_response_s>::share(under)) {
    gl->device.report_host_errors();
    gl->guarded(gl::probe_users(gl->device.gl), [&] { paper.emplace(gl->device, transfer->transfer); });
  }

  nook_gl_s* gl;
  std::optional<gl::TransferTexture> texture;
  Ref<nook_transfer_s> baked;
  Ref<nook_transfer_response_s> response;
  std::optional<gl::PaperTexture> paper;
};

namespace {}  // namespace

nook_result nook_gl_transfer_create(nook_gl gl, nook_transfer_response response, uint32_t vertex_count,
                                    nook_gl_transfer* out) {
  return api::enter("nook_gl_transfer_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(response, "response");
    if (vertex_count < 1 || vertex_count > transfer::max_vertices)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "vertex_count is out of range (got %u, need 1 to %u)",
                    vertex_count, transfer::max_vertices);
    gl->device.need_alive();
    *out = Owned<nook_gl_transfer_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl,
                                           response->response.light_modes, vertex_count)
               .detach();
  });
}

nook_result nook_gl_transfer_update(nook_gl_transfer gl_transfer, const float* vectors,
                                    uint64_t float_count) {
  return api::enter("nook_gl_transfer_update", [&] {
    need(gl_transfer, "gl_transfer");
    need(vectors, "vectors");
    if (!gl_transfer->texture)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "gl_transfer has the paper's form; call nook_gl_transfer_update_light");
    gl::TransferTexture& texture = *gl_transfer->texture;
    if (float_count != texture.float_count())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "float_count is not that of all vertices (got %llu, need %llu)",
                    static_cast<unsigned long long>(float_count),
                    static_cast<unsigned long long>(texture.float_count()));
    nook_gl_s& gl = *gl_transfer->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    // It is the number of floats of a texture that was made, so that it fits a size on every machine.
    const auto count = static_cast<std::size_t>(float_count);
    gl.guarded(gl::probe_users(gl.device.gl), [&] { texture.update({vectors, count}); });
  });
}

nook_result nook_gl_transfer_create_paper(nook_gl gl, nook_transfer baked, nook_transfer_response response,
                                          nook_gl_transfer* out) {
  return api::enter("nook_gl_transfer_create_paper", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(baked, "transfer");
    need(response, "response");
    if (!baked->transfer.paper.is_used())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "transfer has the separated form, need the paper's; call nook_gl_transfer_create and "
                    "nook_transfer_read_vectors");
    transfer::check_same_light(baked->transfer, response->response.light_modes,
                               response->response.light_hash);
    transfer::check_same_lobes(baked->transfer, response->response.lobes);
    gl->device.need_alive();
    *out = Owned<nook_gl_transfer_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, baked, response)
               .detach();
  });
}

nook_result nook_gl_transfer_update_light(nook_gl_transfer gl_transfer, const float* amplitudes,
                                          uint32_t lobe_count) {
  return api::enter("nook_gl_transfer_update_light", [&] {
    need(gl_transfer, "gl_transfer");
    if (!gl_transfer->paper)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "gl_transfer has the vectors of vertices; call nook_gl_transfer_update");
    const transfer::Response& response = gl_transfer->response->response;
    need(amplitudes, "amplitudes");
    transfer::check_amplitudes(amplitudes, lobe_count, response.lobes);
    nook_gl_s& gl = *gl_transfer->gl;
    nook_context_s& context = *gl_transfer->response->context;
    gl.device.need_alive();
    gl.device.report_host_errors();
    const transfer::Transfer& baked = gl_transfer->baked->transfer;
    Vector<float> rows(transfer::lit_row_count(baked) * 3 * baked.paper.light_modes, 0.0f, context.memory());
    write_lit_rows(response, {amplitudes, std::size_t(3) * lobe_count}, baked, context.parallel(),
                   context.memory(), rows);
    gl.guarded(gl::probe_users(gl.device.gl), [&] {
      gl_transfer->paper->update(
          [&](std::span<float> out) { std::copy(rows.begin(), rows.end(), out.begin()); });
    });
  });
}

void nook_gl_transfer_destroy(nook_gl_transfer* gl_transfer) {
  if (!gl_transfer || !*gl_transfer) return;
  (*gl_transfer)->release();
  *gl_transfer = nullptr;
}

nook_result nook_gl_transfer_describe(nook_gl_transfer gl_transfer, nook_gl_transfer_info* info) {
  return api::enter("nook_gl_transfer_describe", [&] {
    need(gl_transfer, "gl_transfer");
    nook_gl_transfer_info known{};
    if (gl_transfer->paper) {
      const gl::PaperTexture& paper = *gl_transfer->paper;
      known.texture = paper.light();
      known.vertex_texture = paper.vertices();
      known.form = NOOK_FORM_PAPER;
      known.bytes = paper.bytes();
      known.glsl = paper.source().c_str();
    } else {
      const gl::TransferTexture& vectors = *gl_transfer->texture;
      known.texture = vectors.name();
      known.form = NOOK_FORM_DEFAULT;
      known.bytes = vectors.bytes();
      known.glsl = vectors.source().c_str();
    }
    write_info(info, known);
  });
}
