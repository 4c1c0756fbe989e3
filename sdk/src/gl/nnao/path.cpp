#include "sdk/src/gl/nnao/path.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

[[noreturn]] void refuse_compute(const Functions& gl) {
  const int major = gl.version / 10, minor = gl.version % 10;
  if (gl.limited_by_host)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "debug.path needs compute shaders (got tier %d on %s %d.%d, need tier %d); leave "
                  "nook_gl_desc.max_tier 0, or use NOOK_NNAO_PATH_AUTOMATIC",
                  tier_of(gl), api_name(gl), major, minor,
                  gl.profile == Profile::desktop ? NOOK_GL_TIER_43 : NOOK_GL_TIER_ES31);
  if (!gl.can.compute)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "debug.path needs compute shaders (got %s %d.%d, need %s or newer); use "
                  "NOOK_NNAO_PATH_AUTOMATIC",
                  api_name(gl), major, minor, gl.profile == Profile::desktop ? "4.3" : "3.1");
  throw Failure(NOOK_ERROR_UNSUPPORTED,
                "debug.path needs compute shaders (got no \"glBindImageTexture\" from get_proc on %s "
                "%d.%d, need it); pass the context's own loader, or use NOOK_NNAO_PATH_AUTOMATIC",
                api_name(gl), major, minor);
}

}  // namespace

nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked) {
  const bool can_compute = gl.can.compute_images;
  if (asked == NOOK_NNAO_PATH_COMPUTE && !can_compute) refuse_compute(gl);
  if (asked != NOOK_NNAO_PATH_AUTOMATIC) return asked;
  // Where AO needs four bytes in place of one to be written by a compute shader, the draw is the better way.
  return can_compute && gl.can.r8_images ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT;
}

}  // namespace nook::gl
