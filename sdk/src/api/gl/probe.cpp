#include <nook/nook_gl_probe.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/probe_handles.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

namespace {

constexpr std::size_t first_info = offsetof(nook_gl_probe_info, glsl) + sizeof(const char*);

}  // namespace

nook_result nook_gl_probe_create(nook_gl gl, nook_probe probe, nook_gl_probe* out) {
  return api::enter("nook_gl_probe_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(probe, "probe");
    gl->device.need_alive();
    *out = Owned<nook_gl_probe_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, probe->probes)
               .detach();
  });
}

nook_result nook_gl_probe_update(nook_gl_probe gl_probe, nook_probe probe) {
  return api::enter("nook_gl_probe_update", [&] {
    need(gl_probe, "gl_probe");
    need(probe, "probe");
    nook_gl_s& gl = *gl_probe->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    gl.guarded(gl::probe_users(gl.device.gl), [&] { gl_probe->texture->update(probe->probes); });
  });
}

void nook_gl_probe_destroy(nook_gl_probe* gl_probe) {
  if (!gl_probe || !*gl_probe) return;
  (*gl_probe)->release();
  *gl_probe = nullptr;
}

nook_result nook_gl_probe_describe(nook_gl_probe gl_probe, nook_gl_probe_info* info) {
  return api::enter("nook_gl_probe_describe", [&] {
    need(gl_probe, "gl_probe");
    nook_gl_probe_info known{};
    known.texture = gl_probe->texture->name();
    known.bytes = gl_probe->texture->bytes();
    known.glsl = gl::probe_glsl();
    write_info(info, first_info, known);
  });
}
