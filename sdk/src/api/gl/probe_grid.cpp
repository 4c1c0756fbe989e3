#include <nook/nook_gl_probe.h>

#include <algorithm>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/probe_handles.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

namespace {

constexpr std::size_t first_info = offsetof(nook_gl_probe_grid_info, reserved) + sizeof(std::uint32_t);

gl::GridForm grid_form(nook_gl_probe_grid_form form) {
  if (form != NOOK_GL_PROBE_GRID_HARMONICS && form != NOOK_GL_PROBE_GRID_ZONAL)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "form is unknown (got %d, need 0 or %d)", form,
                  NOOK_GL_PROBE_GRID_ZONAL);
  return gl::GridForm(form);
}

}  // namespace

nook_result nook_gl_probe_grid_create(nook_gl gl, nook_probe probe, nook_gl_probe_grid_form form,
                                      nook_gl_probe_grid* out) {
  return api::enter("nook_gl_probe_grid_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(probe, "probe");
    const gl::GridForm known = grid_form(form);
    gl->device.need_alive();
    *out = Owned<nook_gl_probe_grid_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, probe->probes,
                                             known)
               .detach();
  });
}

nook_result nook_gl_probe_grid_update(nook_gl_probe_grid grid, nook_probe probe) {
  return api::enter("nook_gl_probe_grid_update", [&] {
    need(grid, "grid");
    need(probe, "probe");
    nook_gl_s& gl = *grid->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    gl.guarded(gl::grids, [&] { grid->volume->update(probe->probes); });
  });
}

void nook_gl_probe_grid_destroy(nook_gl_probe_grid* grid) {
  if (!grid || !*grid) return;
  (*grid)->release();
  *grid = nullptr;
}

nook_result nook_gl_probe_grid_describe(nook_gl_probe_grid grid, nook_gl_probe_grid_info* info) {
  return api::enter("nook_gl_probe_grid_describe", [&] {
    need(grid, "grid");
    const gl::GridVolume& volume = *grid->volume;
    nook_gl_probe_grid_info known{};
    known.texture = volume.name();
    known.bytes = volume.bytes();
    known.glsl = volume.source().c_str();
    std::copy(volume.frame().begin(), volume.frame().end(), known.frame);
    known.walls = volume.walls();
    write_info(info, first_info, known);
  });
}
