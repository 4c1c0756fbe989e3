#include "sdk/src/gl/nnao/path.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

[[noreturn]] void refuse_compute(const Functions& gl) {
  const int major = gl.version / 10, minor = gl.version % 10;
  if (gl.limited_by_host)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.path needs compute shaders (got tier 33 on OpenGL %d.%d, need tier 43); leave "
                  "nook_gl_desc.max_tier 0, or use NOOK_NNAO_PATH_AUTOMATIC",
                  major, minor);
  if (!gl.can.compute)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.path needs compute shaders (got OpenGL %d.%d, need 4.3 or newer); use "
                  "NOOK_NNAO_PATH_AUTOMATIC",
                  major, minor);
  throw Failure(NOOK_ERROR_UNSUPPORTED,
                "desc.path needs compute shaders (got no \"glBindImageTexture\" from get_proc on OpenGL "
                "%d.%d, need it); pass the context's own loader, or use NOOK_NNAO_PATH_AUTOMATIC",
                major, minor);
}

}  // namespace

nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked) {
  const bool can_compute = gl.can.compute_images;
  if (asked == NOOK_NNAO_PATH_COMPUTE && !can_compute) refuse_compute(gl);
  return can_compute && asked != NOOK_NNAO_PATH_FRAGMENT ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT;
}

}  // namespace nook::gl
