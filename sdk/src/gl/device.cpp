#include "sdk/src/gl/device.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "shaders/core/texel_layout.h"

namespace nook::gl {

Device::Device(Context& host, const nook_gl_desc& desc)
    : context(host),
      memory(host.memory()),
      gl(load_functions(desc.get_proc, desc.get_proc_user, desc.max_tier, desc.debug != 0)),
      state_mode(desc.state_mode),
      debug(desc.debug != 0),
      removed_(memory) {
  read_limits();
  if (debug) mark_context();
}

Device::~Device() {
  if (marked_array_ != 0 && may_delete()) gl.DeleteVertexArrays(1, &marked_array_);
}

void Device::read_limits() {
  GLint value = 0;
  if (gl.can.texture_buffers) {
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &value);
    // At the upper limit, a table has 2 GiB, the largest size that 32-bit offsets can address.
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
  if (unchecked_ > 0 && !debug) return;
  // The loop is limited because a context that is lost or not current may return errors forever.
  for (int i = 0; i < 16; ++i) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;
    context.log(NOOK_LOG_WARNING, "nook_gl: the OpenGL error 0x%04x was pending before the call", error);
  }
}

void Device::check(const char* what) const {
  if (unchecked_ > 0 && !debug) return;
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
  need_current();
}

namespace {

// The mark that identifies the context is stored in this attribute of a vertex array. Nook never draws with
// this attribute.
constexpr GLuint marked_attribute = 3;

}  // namespace

GLuint Device::mark() const {
  // The mark is derived from the address of this object, because two objects that live at the same time have
  // different addresses. The mark must fit into the range of integer queries.
  return static_cast<GLuint>((reinterpret_cast<std::uintptr_t>(this) >> 3) & 0x3fffffff) + 1;
}

void Device::mark_context() {
  const GLint bound = integer(gl, GL_VERTEX_ARRAY_BINDING);
  gl.GenVertexArrays(1, &marked_array_);
  gl.BindVertexArray(marked_array_);
  gl.VertexAttribDivisor(marked_attribute, mark());
  gl.BindVertexArray(static_cast<GLuint>(bound));
}

const char* Device::context_fault() const {
  if (!gl.GetString(GL_VERSION)) return "no OpenGL context is current on this thread";
  constexpr const char* other = "another OpenGL context is current on this thread";
  if (!gl.IsVertexArray(marked_array_)) return other;
  const GLint bound = integer(gl, GL_VERTEX_ARRAY_BINDING);
  GLint found = 0;
  gl.BindVertexArray(marked_array_);
  gl.GetVertexAttribiv(marked_attribute, GL_VERTEX_ATTRIB_ARRAY_DIVISOR, &found);
  gl.BindVertexArray(static_cast<GLuint>(bound));
  return static_cast<GLuint>(found) == mark() ? nullptr : other;
}

void Device::need_current() const {
  if (!debug || lost) return;
  if (const char* const fault = context_fault())
    throw Failure(NOOK_ERROR_GL,
                  "%s (need the context of nook_gl_create, even if contexts share objects); make it current "
                  "before the call",
                  fault);
}

bool Device::may_delete() const {
  if (lost) return false;
  if (!debug) return true;
  const char* const fault = context_fault();
  if (!fault) return true;
  if (!told_objects_left_)
    context.log(NOOK_LOG_ERROR,
                "nook_gl: %s, so Nook cannot delete its OpenGL objects (need the context of nook_gl_create); "
                "make it current before you destroy handles",
                fault);
  told_objects_left_ = true;
  return false;
}

void Device::adopt(ObjectKind kind, GLuint name) {
  try {
    if (object_count_ == removed_.capacity())
      removed_.reserve(std::max<std::size_t>(64, 2 * removed_.capacity()));
  } catch (const std::bad_alloc&) {
    delete_now(kind, name);
    throw;
  }
  ++object_count_;
}

void Device::remove(ObjectKind kind, GLuint name) noexcept {
  if (calls_ > 0) return removed_.push_back({kind, name});
  --object_count_;
  delete_now(kind, name);
}

void Device::end_call() noexcept {
  if (--calls_ > 0) return;
  for (const Removed& object : removed_) delete_now(object.kind, object.name);
  object_count_ -= removed_.size();
  removed_.clear();
}

void Device::delete_now(ObjectKind kind, GLuint name) const {
  if (!may_delete()) return;
  switch (kind) {
    case ObjectKind::buffer:
      return gl.DeleteBuffers(1, &name);
    case ObjectKind::framebuffer:
      return gl.DeleteFramebuffers(1, &name);
    case ObjectKind::renderbuffer:
      return gl.DeleteRenderbuffers(1, &name);
    case ObjectKind::texture:
      return gl.DeleteTextures(1, &name);
    case ObjectKind::sampler:
      return gl.DeleteSamplers(1, &name);
    case ObjectKind::query:
      return gl.DeleteQueries(1, &name);
    case ObjectKind::vertex_array:
      return gl.DeleteVertexArrays(1, &name);
    case ObjectKind::transform_feedback:
      return gl.DeleteTransformFeedbacks(1, &name);
    case ObjectKind::program:
      return gl.DeleteProgram(name);
    case ObjectKind::shader:
      return gl.DeleteShader(name);
  }
}

}  // namespace nook::gl
