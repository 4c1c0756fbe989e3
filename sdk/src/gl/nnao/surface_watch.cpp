#include "sdk/src/gl/nnao/surface_watch.h"

namespace nook::gl {

bool SurfaceWatch::begin(const Device& device, const NnaoFrame& frame) {
  const Functions& gl = device.gl;
  if (pending_) {
    GLuint there = GL_FALSE, seen = GL_FALSE;
    gl.GetQueryObjectuiv(query_.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) return false;
    gl.GetQueryObjectuiv(query_.name(), GL_QUERY_RESULT, &seen);
    pending_ = false;
    if (!seen && !told_) report(device);
    told_ = !seen;
  }
  depth_kind_ = frame.depth_kind;
  clip_space_ = frame.clip_space;
  depth_texture_ = frame.depth_texture;
  gl.BeginQuery(GL_ANY_SAMPLES_PASSED, query_.name());
  return true;
}

void SurfaceWatch::end(const Device& device) {
  device.gl.EndQuery(GL_ANY_SAMPLES_PASSED);
  pending_ = true;
}

void SurfaceWatch::report(const Device& device) const {
  device.context.log(
      NOOK_LOG_WARNING,
      "nook_gl: an earlier frame showed no surface: all of frame.depth_texture %u is sky or beyond the far "
      "plane (with frame.depth_kind %d and frame.clip_space %d); check that depth was drawn before the call. "
      "Also check frame.depth_kind, reversed depth, frame.clip_space and frame.sky_depth",
      depth_texture_, depth_kind_, clip_space_);
}

}  // namespace nook::gl
