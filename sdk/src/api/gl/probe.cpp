#include <nook/nook_gl_probe.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/probe/probe_texture.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_gl_probe_s : RefCounted {
  nook_gl_probe_s(nook_gl_s* made_by, const probe::Probes& probes) : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(gl::probe_users(gl->device.gl), [&] { texture.emplace(gl->device, probes); });
  }

  nook_gl_s* gl;
  std::optional<gl::ProbeTexture> texture;
};

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
