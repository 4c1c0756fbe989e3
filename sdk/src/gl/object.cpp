#include "sdk/src/gl/object.h"

#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {

Buffer::Buffer(Device& device, const char* label, std::uint64_t bytes, const void* data, GLenum usage,
               BufferUse use) {
  Buffer made;  // its destructor deletes the name if allocation fails
  made.gl_usage_ = usage;
  made.use_ = use;
  device.gl.GenBuffers(1, &made.name_);
  device.adopt(ObjectKind::buffer, made.name_);
  made.device_ = &device;
  device.gl.BindBuffer(GL_ARRAY_BUFFER, made.name_);
  device.gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
  device.check("allocating a buffer");
  device.label(GL_BUFFER, made.name_, label);
  made.bytes_ = bytes;
  device.buffer_bytes += bytes;
  if (use == BufferUse::ao) device.ao_bytes += bytes;
  swap(made);
}

Buffer::~Buffer() {
  if (!device_) return;
  device_->buffer_bytes -= bytes_;
  if (use_ == BufferUse::ao) device_->ao_bytes -= bytes_;
  device_->remove(ObjectKind::buffer, name_);
}

// Allocates new storage of at least `bytes` bytes for the buffer. The old contents are lost.
void Buffer::renew(std::uint64_t bytes) {
  const Functions& gl = device_->gl;
  gl.BindBuffer(GL_ARRAY_BUFFER, name_);
  // If the buffer has to grow, it allocates 50 % more, so that a growing scene rarely reallocates.
  const std::uint64_t kept = bytes > bytes_ ? bytes + bytes / 2 : bytes_;
  // New storage is necessary. If the buffer were only mapped with GL_MAP_INVALIDATE_BUFFER_BIT, Mesa's
  // softpipe driver would still use cached texels of the old contents.
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(kept), nullptr, gl_usage_);
  device_->buffer_bytes += kept - bytes_;
  bytes_ = kept;
}

void Buffer::send(std::uint64_t bytes, const void* data) {
  renew(bytes);
  device_->gl.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void* Buffer::begin_write(std::uint64_t bytes) {
  const Functions& gl = device_->gl;
  renew(bytes);
  if (!gl.can.maps) {
    if (!staging_) staging_.emplace(device_->memory);
    staging_->resize(bytes);
    return staging_->data();
  }
  void* memory = gl.MapBufferRange(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes),
                                   GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  if (!memory)
    throw Failure(NOOK_ERROR_GL,
                  "glMapBufferRange gave no memory (%llu bytes); is the context of nook_gl_create current?",
                  static_cast<unsigned long long>(bytes));
  return memory;
}

bool Buffer::end_write() {
  const Functions& gl = device_->gl;
  if (gl.can.maps) return gl.UnmapBuffer(GL_ARRAY_BUFFER) == GL_TRUE;
  gl.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(staging_->size()), staging_->data());
  staging_.reset();  // free the memory, because AO is large and such writes are rare
  return true;
}

void Buffer::fail_write(std::uint64_t bytes) {
  throw Failure(
      NOOK_ERROR_GL,
      "glUnmapBuffer reported lost contents (%llu bytes, %d attempts); call again once the display is "
      "back",
      static_cast<unsigned long long>(bytes), max_write_attempts);
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(name_, other.name_);
  std::swap(gl_usage_, other.gl_usage_);
  std::swap(use_, other.use_);
  std::swap(bytes_, other.bytes_);
  std::swap(staging_, other.staging_);
}

void read_buffer_bytes(const Device& device, GLuint buffer, std::uint64_t offset, std::uint64_t bytes,
                       void* out) {
  const Functions& gl = device.gl;
  const auto start = static_cast<GLintptr>(offset);
  const auto size = static_cast<GLsizeiptr>(bytes);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  if (gl.can.buffer_reads) {
    gl.GetBufferSubData(GL_ARRAY_BUFFER, start, size, out);
    return;
  }
  const void* memory =
      gl.can.maps ? gl.MapBufferRange(GL_ARRAY_BUFFER, start, size, GL_MAP_READ_BIT) : nullptr;
  if (!memory)
    throw Failure(NOOK_ERROR_GL,
                  "a buffer cannot be read (%llu bytes); is the context of nook_gl_create current?",
                  static_cast<unsigned long long>(bytes));
  std::memcpy(out, memory, bytes);
  if (gl.UnmapBuffer(GL_ARRAY_BUFFER) != GL_TRUE)
    throw Failure(NOOK_ERROR_GL, "glUnmapBuffer reported lost contents (%llu bytes read); call again",
                  static_cast<unsigned long long>(bytes));
}

Object Object::make(Device& device, Kind kind) {
  const Functions& gl = device.gl;
  GLuint name = 0;
  switch (kind) {
    case Kind::framebuffer:
      gl.GenFramebuffers(1, &name);
      break;
    case Kind::renderbuffer:
      gl.GenRenderbuffers(1, &name);
      break;
    case Kind::texture:
      gl.GenTextures(1, &name);
      break;
    case Kind::sampler:
      gl.GenSamplers(1, &name);
      break;
    case Kind::query:
      gl.GenQueries(1, &name);
      break;
    case Kind::vertex_array:
      gl.GenVertexArrays(1, &name);
      break;
    case Kind::transform_feedback:
      gl.GenTransformFeedbacks(1, &name);
      break;
    case Kind::program:
      name = gl.CreateProgram();
      break;
    case Kind::buffer:
    case Kind::shader:
      break;  // class Buffer creates buffers; shader_program.cpp creates shaders, which need a stage
  }
  return Object(device, kind, name);
}

Object::~Object() {
  if (device_) device_->remove(kind_, name_);
}

FeedbackTarget::FeedbackTarget(Device& device) {
  const Functions& gl = device.gl;
  framebuffer_ = Object::make(device, Object::Kind::framebuffer);
  renderbuffer_ = Object::make(device, Object::Kind::renderbuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  gl.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                             renderbuffer_.name());
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(NOOK_ERROR_GL, "a framebuffer with an RGBA8 renderbuffer is not complete (status 0x%04x)",
                  status);
  device.label(GL_FRAMEBUFFER, framebuffer_.name(), "nook: transform feedback");
  if (gl.BindTransformFeedback && gl.GenTransformFeedbacks && gl.DeleteTransformFeedbacks)
    feedback_ = Object::make(device, Object::Kind::transform_feedback);
}

void FeedbackTarget::begin(const Device& device) const {
  const Functions& gl = device.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  if (feedback_.name()) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.name());
  gl.Enable(GL_RASTERIZER_DISCARD);
  set_primitive_restart(gl, false);
}

void FeedbackTarget::end(const Device& device) {
  device.gl.Disable(GL_RASTERIZER_DISCARD);
  device.gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

}  // namespace nook::gl
