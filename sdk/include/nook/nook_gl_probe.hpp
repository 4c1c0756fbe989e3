// C++17 wrappers of probes in OpenGL: nook_gl_probe.h.
#ifndef NOOK_GL_PROBE_HPP
#define NOOK_GL_PROBE_HPP

#include "nook_gl.hpp"
#include "nook_gl_probe.h"
#include "nook_probe.hpp"

namespace nook {
inline namespace wrapper {

// A probe or a grid in a texture of its own. Every function belongs to the context thread, as nook_gl_probe.h
// documents.
class GlProbe : public Unique<nook_gl_probe, nook_gl_probe_destroy> {
 public:
  GlProbe(const Gl& gl, nook_probe probe) : Unique(create(gl, probe)) {}

  void update(nook_probe probe) { check(nook_gl_probe_update(get(), probe)); }
  nook_gl_probe_info info() const {
    nook_gl_probe_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_probe_describe(get(), &info));
    return info;
  }

 private:
  static nook_gl_probe create(const Gl& gl, nook_probe probe) {
    nook_gl_probe handle = nullptr;
    check(nook_gl_probe_create(gl.get(), probe, &handle));
    return handle;
  }
};

// A grid of diffuse light in a 3D texture of its own; the same holds.
class GlProbeGrid : public Unique<nook_gl_probe_grid, nook_gl_probe_grid_destroy> {
 public:
  GlProbeGrid(const Gl& gl, nook_probe probe, nook_gl_probe_grid_form form)
      : Unique(create(gl, probe, form)) {}

  void update(nook_probe probe) { check(nook_gl_probe_grid_update(get(), probe)); }
  nook_gl_probe_grid_info info() const {
    nook_gl_probe_grid_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_probe_grid_describe(get(), &info));
    return info;
  }

 private:
  static nook_gl_probe_grid create(const Gl& gl, nook_probe probe, nook_gl_probe_grid_form form) {
    nook_gl_probe_grid handle = nullptr;
    check(nook_gl_probe_grid_create(gl.get(), probe, form, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
