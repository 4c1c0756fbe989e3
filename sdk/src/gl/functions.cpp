#include "sdk/src/gl/functions.h"

#include <algorithm>
#include <cstring>

#include "sdk/src/core/failure.h"

namespace nook::gl {
namespace {

// The constants and functions of EXT_disjoint_timer_query are the same as in OpenGL 3.3.
constexpr const char* es_timer_extension = "GL_EXT_disjoint_timer_query";
constexpr GLenum num_extensions = 0x821D;
// A limit that no context reaches: OpenGL ES with all of its extensions lists about a hundred formats.
constexpr std::size_t most_compressed_formats = 256;

class Loader {
 public:
  Loader(nook_gl_proc_fn get_proc, void* user) : get_proc_(get_proc), user_(user) {}

  template <class F>
  void optional(F& function, const char* name) const {
    function = reinterpret_cast<F>(get_proc_(user_, name));
  }
  // Loads a function. `version` is the version or extension that contains the function, such as "OpenGL 3.3",
  // for the message.
  template <class F>
  void required(F& function, const char* name, const char* version) const {
    optional(function, name);
    if (!function)
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "get_proc did not return the required function \"%s\" of %s; make the context current "
                    "and pass the context's own loader",
                    name, version);
  }

 private:
  nook_gl_proc_fn get_proc_;
  void* user_;
};

// GL_VERSION contains "OpenGL ES" in OpenGL ES, and also in a WebGL context that a browser's build uses. No
// other query distinguishes them from desktop OpenGL.
Profile profile_of(const Functions& gl) {
  const auto* version = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  if (!version || !std::strstr(version, "OpenGL ES")) return Profile::desktop;
  return std::strstr(version, "WebGL") ? Profile::webgl : Profile::es;
}

void check_version(const Functions& gl) {
  const int major = gl.version / 10, minor = gl.version % 10;
  if (gl.profile != Profile::desktop) {
    if (gl.version < 30)
      throw Failure(NOOK_ERROR_UNSUPPORTED, "the current context has %s %d.%d, need %s 3.0 or newer",
                    api_name(gl), major, minor, api_name(gl));
    return;
  }
  if (gl.version < 33)
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the current context has OpenGL %d.%d, need 3.3 core or newer%s",
                  major, minor, gl.version == 0 ? "; is a context current on this thread?" : "");
}

// GL_MAJOR_VERSION exists since OpenGL 3.0 and OpenGL ES 3.0. Older versions leave the results at 0.
void read_version(Functions& gl) {
  gl.profile = profile_of(gl);
  if (gl.profile == Profile::es) {
    // The query of the version would cause an error in OpenGL ES 2.0, and the host would find this error
    // later. So the text is checked first.
    const char* const number = std::strstr(reinterpret_cast<const char*>(gl.GetString(GL_VERSION)), "ES 2.");
    if (number) gl.version = 20 + (number[5] - '0');
    if (number) return;
  }
  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  gl.version = 10 * major + minor;
}

bool has_extension(const Functions& gl, const Loader& loader, const char* name) {
  PFNGLGETSTRINGIPROC get_string = nullptr;
  loader.optional(get_string, "glGetStringi");
  if (!get_string) return false;
  GLint count = 0;
  gl.GetIntegerv(num_extensions, &count);
  for (GLint i = 0; i < count; ++i) {
    const auto* extension = reinterpret_cast<const char*>(get_string(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (extension && std::strcmp(extension, name) == 0) return true;
  }
  return false;
}

// This test is for WebGL. There, the list of extensions also contains extensions that the page has not
// enabled. But the list of compressed formats contains only formats of enabled extensions.
bool lists_compressed_format(const Functions& gl, GLenum format) {
  GLint count = 0;
  gl.GetIntegerv(GL_NUM_COMPRESSED_TEXTURE_FORMATS, &count);
  if (count < 1 || std::size_t(count) > most_compressed_formats) return false;
  GLint formats[most_compressed_formats] = {};
  gl.GetIntegerv(GL_COMPRESSED_TEXTURE_FORMATS, formats);
  return std::find(formats, formats + count, GLint(format)) != formats + count;
}

void load_common(Functions& gl, const Loader& loader) {
  const char* const version = gl.profile == Profile::desktop ? "OpenGL 3.3" : "OpenGL ES 3.0";
#define NOOK_X(name) loader.required(gl.name, "gl" #name, version);
  NOOK_GL_FUNCTIONS_COMMON(NOOK_X)
  if (gl.profile != Profile::webgl) {
    NOOK_GL_FUNCTIONS_MAPS(NOOK_X)
  }
  if (gl.profile == Profile::desktop) {
    NOOK_GL_FUNCTIONS_33(NOOK_X)
  } else {
    NOOK_GL_FUNCTIONS_ES30(NOOK_X)
  }
#undef NOOK_X
}

void load_debug(Functions& gl, const Loader& loader) {
  const char* const version = gl.profile == Profile::desktop ? "OpenGL 3.3" : "OpenGL ES 3.0";
#define NOOK_X(name) loader.required(gl.name, "gl" #name, version);
  NOOK_GL_FUNCTIONS_DEBUG(NOOK_X)
#undef NOOK_X
}

void load_compute(Functions& gl, const Loader& loader, int max_tier) {
  const bool desktop = gl.profile == Profile::desktop;
  const bool has_compute = desktop ? gl.version >= 43 : gl.profile == Profile::es && gl.version >= 31;
  const bool allowed = max_tier != NOOK_GL_TIER_33 && max_tier != NOOK_GL_TIER_ES30;
  gl.can.compute = has_compute && allowed;
  gl.limited_by_host = has_compute && !allowed;
  if (!gl.can.compute) return;
  const char* const version = desktop ? "OpenGL 4.3" : "OpenGL ES 3.1";
#define NOOK_X(name) loader.required(gl.name, "gl" #name, version);
  NOOK_GL_FUNCTIONS_COMPUTE(NOOK_X)
#undef NOOK_X
  loader.optional(gl.BindImageTexture, "glBindImageTexture");
  gl.can.compute_images = gl.BindImageTexture != nullptr;
  gl.can.r8_images = desktop;
}

bool load_fences(Functions& gl, const Loader& loader) {
  loader.optional(gl.FenceSync, "glFenceSync");
  loader.optional(gl.ClientWaitSync, "glClientWaitSync");
  loader.optional(gl.DeleteSync, "glDeleteSync");
  return gl.FenceSync && gl.ClientWaitSync && gl.DeleteSync;
}

void load_feedback_objects(Functions& gl, const Loader& loader) {
  loader.optional(gl.BindTransformFeedback, "glBindTransformFeedback");
  loader.optional(gl.DeleteTransformFeedbacks, "glDeleteTransformFeedbacks");
  loader.optional(gl.GenTransformFeedbacks, "glGenTransformFeedbacks");
}

// A loader may return a stub for a function that the context does not have. So the version is checked before
// the pointer.
void load_desktop_options(Functions& gl, const Loader& loader) {
  gl.can.texture_buffers = gl.can.maps = gl.can.buffer_reads = true;
  gl.can.indexed_feedback = gl.can.norm16_targets = gl.can.desktop_raster = true;
  gl.can.texture_sizes = gl.can.indexed_draw_buffers = true;
  gl.can.sample_textures = gl.can.sample_arrays = true;
  gl.can.timestamps = load_fences(gl, loader);
  if (gl.version >= 40) {
    load_feedback_objects(gl, loader);
    loader.optional(gl.BlendEquationSeparatei, "glBlendEquationSeparatei");
    loader.optional(gl.BlendFuncSeparatei, "glBlendFuncSeparatei");
  }
  gl.can.indexed_viewports = gl.version >= 41;
  gl.can.query_buffers = gl.version >= 44;
  gl.can.stencil_textures = gl.version >= 43;
  gl.can.rgtc_textures = true;
  gl.can.eac_textures = gl.version >= 43 || has_extension(gl, loader, "GL_ARB_ES3_compatibility");
  if (gl.can.indexed_viewports) {
    loader.optional(gl.GetFloati_v, "glGetFloati_v");
    loader.optional(gl.ViewportIndexedf, "glViewportIndexedf");
  }
  if (gl.version < 43) return;
  loader.optional(gl.ObjectLabel, "glObjectLabel");
  loader.optional(gl.InvalidateFramebuffer, "glInvalidateFramebuffer");
}

void load_es_options(Functions& gl, const Loader& loader) {
  load_feedback_objects(gl, loader);
  const bool is_web = gl.profile == Profile::webgl;
  gl.can.rgtc_textures = is_web ? lists_compressed_format(gl, GL_COMPRESSED_SIGNED_RG_RGTC2)
                                : has_extension(gl, loader, "GL_EXT_texture_compression_rgtc");
  gl.can.eac_textures = !is_web || lists_compressed_format(gl, GL_COMPRESSED_SIGNED_RG11_EAC);
  loader.optional(gl.InvalidateFramebuffer, "glInvalidateFramebuffer");
  if (is_web) {
    loader.optional(gl.GetBufferSubData, "glGetBufferSubData");
    gl.can.buffer_reads = gl.GetBufferSubData != nullptr;
    return;
  }
  gl.can.maps = true;
  if (gl.version >= 31) {
    loader.optional(gl.GetTexLevelParameteriv, "glGetTexLevelParameteriv");
    gl.can.texture_sizes = gl.GetTexLevelParameteriv != nullptr;
    gl.can.stencil_textures = gl.can.sample_textures = true;
  }
  if (gl.version >= 32) {
    gl.can.sample_arrays = true;
    loader.optional(gl.ColorMaski, "glColorMaski");
    loader.optional(gl.Disablei, "glDisablei");
    loader.optional(gl.Enablei, "glEnablei");
    loader.optional(gl.IsEnabledi, "glIsEnabledi");
    loader.optional(gl.GetBooleani_v, "glGetBooleani_v");
    loader.optional(gl.BlendEquationSeparatei, "glBlendEquationSeparatei");
    loader.optional(gl.BlendFuncSeparatei, "glBlendFuncSeparatei");
    loader.optional(gl.ObjectLabel, "glObjectLabel");
    gl.can.indexed_draw_buffers =
        gl.ColorMaski && gl.Disablei && gl.Enablei && gl.IsEnabledi && gl.GetBooleani_v;
  }
  if (has_extension(gl, loader, es_timer_extension)) {
    loader.optional(gl.QueryCounter, "glQueryCounterEXT");
    loader.optional(gl.GetQueryObjectui64v, "glGetQueryObjectui64vEXT");
    gl.can.timestamps = gl.QueryCounter && gl.GetQueryObjectui64v && load_fences(gl, loader);
  }
}

}  // namespace

int tier_of(const Functions& gl) {
  if (gl.profile == Profile::desktop) return gl.can.compute ? NOOK_GL_TIER_43 : NOOK_GL_TIER_33;
  return gl.can.compute ? NOOK_GL_TIER_ES31 : NOOK_GL_TIER_ES30;
}

const char* api_name(const Functions& gl) {
  return gl.profile == Profile::desktop ? "OpenGL" : "OpenGL ES";
}

Functions load_functions(nook_gl_proc_fn get_proc, void* user, int max_tier, bool debug) {
  const Loader loader(get_proc, user);
  Functions gl;
  loader.required(gl.GetString, "glGetString", "OpenGL 3.3");
  loader.required(gl.GetIntegerv, "glGetIntegerv", "OpenGL 3.3");
  read_version(gl);
  check_version(gl);
  load_common(gl, loader);
  load_compute(gl, loader, max_tier);
  if (gl.profile == Profile::desktop)
    load_desktop_options(gl, loader);
  else
    load_es_options(gl, loader);
  if (debug) load_debug(gl, loader);
  return gl;
}

}  // namespace nook::gl
