#include "sdk/src/gl/device.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "shaders/core/texel_layout.h"

namespace nook::gl {

Device::Device(Context& host, const nook_gl_desc& desc)
    : context(host),
      memory(host.memory()),
      gl(load_functions(desc.get_proc, desc.get_proc_user, desc.max_tier)),
      state_mode(desc.state_mode) {
  GLint value = 0;
  if (gl.can.texture_buffers) {
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &value);
    // A table of 2 GiB is as much as 32 bits count.
    max_texels = static_cast<std::uint32_t>(std::clamp(value, 65536, 1 << 27));
  } else {
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &value);
    max_texels = static_cast<std::uint32_t>(std::clamp(value, NOOK_TEXEL_ROW, 1 << 14)) * NOOK_TEXEL_ROW;
  }
  if (!gl.can.compute) return;
  gl.GetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &value);
  storage_alignment = static_cast<std::uint64_t>(std::max(value, 16));
  gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &value);
  max_piece_bytes = std::min(max_piece_bytes, static_cast<std::uint64_t>(std::max(value, 1 << 24)));
}

void Device::report_host_errors() const {
  // A context that is lost or not current may return errors forever.
  for (int i = 0; i < 16; ++i) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;
    context.log(NOOK_LOG_WARNING, "nook_gl: the host left the OpenGL error 0x%04x", error);
  }
}

void Device::check(const char* what) const {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY)
    throw Failure(NOOK_ERROR_OUT_OF_MEMORY, "OpenGL ran out of memory while %s; free some of it", what);
  throw Failure(NOOK_ERROR_GL, "OpenGL reported 0x%04x while %s; is the context of nook_gl_create current?",
                error, what);
}

void Device::need_alive() const {
  if (lost)
    throw Failure(NOOK_ERROR_GL,
                  "the OpenGL context was lost; destroy this nook_gl and create one on the new context");
}

}  // namespace nook::gl
