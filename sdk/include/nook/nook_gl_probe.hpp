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

// Cube maps that the host renders become probes of a GlProbe, a GlProbeGrid or both; the same holds.
class GlProbeCapture : public Unique<nook_gl_probe_capture, nook_gl_probe_capture_destroy> {
 public:
  // Defaults, for the caller to change.
  static nook_gl_probe_capture_desc defaults() {
    nook_gl_probe_capture_desc desc;
    check(nook_gl_probe_capture_desc_init(&desc, sizeof desc, NOOK_VERSION));
    return desc;
  }
  GlProbeCapture(const Gl& gl, const nook_gl_probe_capture_desc& desc) : Unique(create(gl, desc)) {}

  void add(std::uint32_t index, std::uint32_t cube_map) {
    check(nook_gl_probe_capture_add(get(), index, cube_map));
  }
  void reset(std::uint32_t index) { check(nook_gl_probe_capture_reset(get(), index)); }
  nook_gl_probe_capture_result read(std::uint32_t index) const {
    nook_gl_probe_capture_result result{};
    result.struct_size = sizeof result;
    check(nook_gl_probe_capture_read(get(), index, &result));
    return result;
  }
  Probe solve() const {
    nook_probe handle = nullptr;
    check(nook_gl_probe_capture_solve(get(), &handle));
    return Probe(handle);
  }

 private:
  static nook_gl_probe_capture create(const Gl& gl, const nook_gl_probe_capture_desc& desc) {
    nook_gl_probe_capture handle = nullptr;
    check(nook_gl_probe_capture_create(gl.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
