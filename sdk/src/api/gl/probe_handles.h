// The objects behind the handles of probes in OpenGL. Their OpenGL objects outlive the handle nook_gl,
// because each holds a reference to its owner.
#pragma once

#include <nook/nook_gl_probe.h>

#include <optional>

#include "sdk/src/api/gl/handle.h"
#include "sdk/src/gl/probe/grid_volume.h"
#include "sdk/src/gl/probe/probe_texture.h"

struct nook_gl_probe_s : nook::RefCounted {
  nook_gl_probe_s(nook_gl_s* made_by, const nook::probe::Probes& probes) : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(nook::gl::probe_users(gl->device.gl), [&] { texture.emplace(gl->device, probes); });
  }

  nook_gl_s* gl;
  std::optional<nook::gl::ProbeTexture> texture;
};

struct nook_gl_probe_grid_s : nook::RefCounted {
  nook_gl_probe_grid_s(nook_gl_s* made_by, const nook::probe::Probes& probes, nook::gl::GridForm form)
      : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(nook::gl::grids, [&] { volume.emplace(gl->device, probes, form); });
  }

  nook_gl_s* gl;
  std::optional<nook::gl::GridVolume> volume;
};
