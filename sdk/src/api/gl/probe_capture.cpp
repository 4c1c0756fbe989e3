#include <nook/experimental/nook_capture.h>

#include <algorithm>
#include <optional>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/upload.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/gl/probe/capture.h"

using namespace nook;

// Holds references to the textures that the capture writes, so that they stay alive.
struct nook_gl_capture_s : RefCounted {
  nook_gl_capture_s(nook_gl_s* made_by, const nook_gl_capture_desc& desc, const gl::CaptureSettings& settings)
      : gl(made_by),
        probe(Ref<nook_gl_upload_s>::share(desc.probe)),
        grid(Ref<nook_gl_upload_s>::share(desc.grid)) {
    gl->device.report_host_errors();
    gl->guarded(gl::captures, [&] {
      capture.emplace(gl->device,
                      gl::CaptureTargets{probe ? probe->probe() : nullptr, grid ? grid->grid() : nullptr},
                      settings);
    });
  }

  nook_gl_s* gl;
  Ref<nook_gl_upload_s> probe, grid;
  std::optional<gl::ProbeCapture> capture;
};

namespace {

constexpr std::uint32_t min_face_px = 4, max_face_px = 512, max_level = 15, max_history = 65536;

gl::CaptureSettings settings_of(const nook_gl_capture_desc& desc) {
  check_range("desc.face_size_px", desc.face_size_px, min_face_px, max_face_px);
  check_range("desc.level", desc.level, 0, max_level);
  check_range("desc.history", desc.history, 1, max_history);
  if (desc.light != NOOK_GL_CAPTURE_ALL && desc.light != NOOK_GL_CAPTURE_SKY)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.light is unknown (got %d, need 0 or %d)", desc.light,
                  NOOK_GL_CAPTURE_SKY);
  check_fits("desc.match_sh", desc.match_sh, desc.match_sh == 0 || desc.match_sh == 1, "0 or 1");
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", desc.reserved);
  gl::CaptureSettings settings;
  settings.face_size_px = desc.face_size_px;
  settings.level = desc.level;
  settings.history = desc.history;
  settings.sky = desc.light == NOOK_GL_CAPTURE_SKY;
  settings.constraint = desc.match_sh ? probe::Constraint::bands : probe::Constraint::none;
  return settings;
}

void check_targets(nook_gl gl, const nook_gl_capture_desc& desc) {
  if (!desc.probe && !desc.grid)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.probe and desc.grid are both NULL; set at least one of them to the upload that "
                  "receives the light");
  if ((desc.probe && desc.probe->gl != gl) || (desc.grid && desc.grid->gl != gl))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.probe or desc.grid belongs to another nook_gl; upload both with the same nook_gl as "
                  "the capture");
  if (desc.probe && !desc.probe->probe())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.probe is not an upload of NOOK_GL_PROBE_LOBES; pass a grid of diffuse light as "
                  "desc.grid instead");
  if (desc.grid && !desc.grid->grid())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.grid is not an upload of NOOK_GL_PROBE_SH or NOOK_GL_PROBE_ZH3; pass an upload of "
                  "lobes as desc.probe instead");
  if (desc.probe && desc.probe->probe()->basis().domain != probe::Domain::sphere)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the lobes of desc.probe cover only a hemisphere, but a cube map covers all directions; "
                  "create the probe with NOOK_PROBE_DOMAIN_SPHERE");
  if (desc.probe && desc.grid && !(desc.probe->probe()->grid() == desc.grid->grid()->grid()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.probe and desc.grid were uploaded from different grids; use grids with the same "
                  "counts, origin and spacing");
}

void need_index(const gl::ProbeCapture& capture, std::uint32_t index) {
  check_index("index", index, capture.size());
}

void write_vec3(float* out, Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

nook_gl_capture_info to_public(const gl::CaptureResult& result) {
  nook_gl_capture_info answer{};
  answer.maps = result.maps;
  for (std::size_t i = 0; i < result.harmonics.size(); ++i)
    write_vec3(answer.harmonics + 3 * i, result.harmonics[i]);
  write_vec3(answer.sun_irradiance, result.sun_irradiance);
  write_vec3(answer.sun_direction, result.sun_direction);
  answer.sun_solid_angle = result.sun_solid_angle;
  answer.used_solid_angle = result.used_solid_angle;
  return answer;
}

}  // namespace

nook_result nook_gl_capture_create(nook_gl gl, const nook_gl_capture_desc* desc, nook_gl_capture* out) {
  return api::enter("nook_gl_capture_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    const nook_gl_capture_desc known = read_descriptor(desc);
    const gl::CaptureSettings settings = settings_of(known);
    gl->device.need_alive();
    check_targets(gl, known);
    *out = Owned<nook_gl_capture_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, known, settings)
               .detach();
  });
}

nook_result nook_gl_capture_add(nook_gl_capture capture, uint32_t index, uint32_t cube_map, int32_t restart) {
  return api::enter("nook_gl_capture_add", [&] {
    need(capture, "capture");
    nook_gl_s& gl = *capture->gl;
    gl.device.need_alive();
    need_index(*capture->capture, index);
    if (restart != 0 && restart != 1)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "restart is %d, need 0 or 1", restart);
    gl.device.report_host_errors();
    gl.guarded(gl::captures, [&] { capture->capture->add(index, cube_map, restart != 0); });
  });
}

nook_result nook_gl_capture_read(nook_gl_capture capture, uint32_t index, nook_gl_capture_info* result) {
  return api::enter("nook_gl_capture_read", [&] {
    need(capture, "capture");
    need_index(*capture->capture, index);
    nook_gl_s& gl = *capture->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    gl.guarded(gl::captures, [&] { write_info(result, to_public(capture->capture->read(index))); });
  });
}

nook_result nook_gl_capture_solve(nook_gl_capture capture, nook_probe* out) {
  return api::enter("nook_gl_capture_solve", [&] {
    need(out, "out");
    *out = nullptr;
    need(capture, "capture");
    nook_gl_s& gl = *capture->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    gl.guarded(gl::captures, [&] {
      *out = Owned<nook_probe_s>::make(gl.device.memory, Ref<const Context>::share(&gl.device.context),
                                       capture->capture->read_all())
                 .detach();
    });
  });
}

void nook_gl_capture_destroy(nook_gl_capture* capture) {
  if (!capture || !*capture) return;
  (*capture)->release();
  *capture = nullptr;
}
