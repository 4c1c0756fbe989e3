#include "sdk/src/gl/functions.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

template <class F>
void load_optional(F& function, nook_gl_proc_fn get_proc, void* user, const char* name) {
  function = reinterpret_cast<F>(get_proc(user, name));
}

template <class F>
void load_required(F& function, nook_gl_proc_fn get_proc, void* user, const char* name, const char* version) {
  load_optional(function, get_proc, user, name);
  if (!function)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "required function \"%s\" of OpenGL %s not provided by get_proc; make the context current and pass "
        "its own loader",
        name, version);
}

}  // namespace

Functions load_functions(nook_gl_proc_fn get_proc, void* user, int max_tier) {
  Functions gl;
#define NOOK_X(name) load_required(gl.name, get_proc, user, "gl" #name, "3.3");
  NOOK_GL_FUNCTIONS_33(NOOK_X)
#undef NOOK_X

  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  gl.version = 10 * major + minor;
  if (gl.version < 33)
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the current context has OpenGL %d.%d, need 3.3 core or newer%s",
                  major, minor, major == 0 ? "; is a context current on this thread?" : "");

  const bool has_compute = gl.version >= 43;
  gl.can.compute = has_compute && (max_tier == 0 || max_tier >= 43);
  gl.limited_by_host = has_compute && !gl.can.compute;
  if (gl.can.compute) {
#define NOOK_X(name) load_required(gl.name, get_proc, user, "gl" #name, "4.3");
    NOOK_GL_FUNCTIONS_43(NOOK_X)
#undef NOOK_X
    load_optional(gl.BindImageTexture, get_proc, user, "glBindImageTexture");
    gl.can.compute_images = gl.BindImageTexture != nullptr;
  }
  // A loader may return a stub for a function that the context lacks, so the version is tested before the
  // pointer.
  if (gl.version >= 40) {
    load_optional(gl.BindTransformFeedback, get_proc, user, "glBindTransformFeedback");
    load_optional(gl.DeleteTransformFeedbacks, get_proc, user, "glDeleteTransformFeedbacks");
    load_optional(gl.GenTransformFeedbacks, get_proc, user, "glGenTransformFeedbacks");
    load_optional(gl.BlendEquationSeparatei, get_proc, user, "glBlendEquationSeparatei");
    load_optional(gl.BlendFuncSeparatei, get_proc, user, "glBlendFuncSeparatei");
  }
  gl.can.indexed_viewports = gl.version >= 41;
  gl.can.query_buffers = gl.version >= 44;
  gl.can.stencil_textures = gl.version >= 43;
  if (gl.can.indexed_viewports) {
    load_optional(gl.GetFloati_v, get_proc, user, "glGetFloati_v");
    load_optional(gl.ViewportIndexedf, get_proc, user, "glViewportIndexedf");
  }
  if (gl.version >= 43) load_optional(gl.ObjectLabel, get_proc, user, "glObjectLabel");
  return gl;
}

}  // namespace nook::gl
