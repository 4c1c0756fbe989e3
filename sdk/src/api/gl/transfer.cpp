#include <nook/nook_gl_transfer.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/transfer/transfer_texture.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_gl_transfer_s : RefCounted {
  nook_gl_transfer_s(nook_gl_s* made_by, std::uint32_t light_modes, std::uint32_t vertices) : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(gl::probe_users(gl->device.gl), [&] { texture.emplace(gl->device, light_modes, vertices); });
  }

  nook_gl_s* gl;
  std::optional<gl::TransferTexture> texture;
};

namespace {

constexpr std::size_t first_info = offsetof(nook_gl_transfer_info, glsl) + sizeof(const char*);

}  // namespace

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

void nook_gl_transfer_destroy(nook_gl_transfer* gl_transfer) {
  if (!gl_transfer || !*gl_transfer) return;
  (*gl_transfer)->release();
  *gl_transfer = nullptr;
}

nook_result nook_gl_transfer_describe(nook_gl_transfer gl_transfer, nook_gl_transfer_info* info) {
  return api::enter("nook_gl_transfer_describe", [&] {
    need(gl_transfer, "gl_transfer");
    nook_gl_transfer_info known{};
    known.texture = gl_transfer->texture->name();
    known.bytes = gl_transfer->texture->bytes();
    known.glsl = gl_transfer->texture->source().c_str();
    write_info(info, first_info, known);
  });
}
