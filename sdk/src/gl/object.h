// OpenGL names that are deleted with their owner, or forgotten if the OpenGL context is lost; buffers; and
// the objects of transform feedback.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

enum class BufferUse { working, ao };

class Buffer {
 public:
  Buffer() = default;
  // Binds GL_ARRAY_BUFFER, like every function here that writes. If data is NULL, the bytes are undefined.
  // Throws Failure.
  Buffer(Device& device, const char* label, std::uint64_t bytes, const void* data, GLenum usage,
         BufferUse use = BufferUse::working);
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer old(std::move(other));
    swap(old);
    return *this;
  }
  ~Buffer();

  GLuint name() const { return name_; }
  std::uint64_t bytes() const { return bytes_; }
  // Replaces the contents: fill(memory) writes `bytes` bytes. The GPU may still read the old contents, which
  // stay intact. Nothing waits, with one exception: if a texture reads the buffer, NVIDIA's driver waits for
  // the GPU when it is mapped. OpenGL may lose what was written, as when the display changes; then fill is
  // called again. Throws Failure if OpenGL has no memory or keeps losing the contents.
  template <class Fill>
  void write(std::uint64_t bytes, Fill&& fill) {
    for (int attempt = 0; attempt < max_write_attempts; ++attempt) {
      fill(begin_write(bytes));
      if (end_write()) return;
    }
    fail_write(bytes);
  }
  // Does the same from the caller's memory, for buffers that a texture reads: NVIDIA's driver does not wait
  // here. It reports no failure, because an update does not read OpenGL's errors; the host finds them.
  void send(std::uint64_t bytes, const void* data);

 private:
  static constexpr int max_write_attempts = 3;
  void renew(std::uint64_t bytes);
  void* begin_write(std::uint64_t bytes);
  bool end_write();
  [[noreturn]] static void fail_write(std::uint64_t bytes);
  void swap(Buffer& other) noexcept;

  Device* device_ = nullptr;
  GLuint name_ = 0;
  GLenum gl_usage_ = GL_STATIC_DRAW;
  BufferUse use_ = BufferUse::working;
  std::uint64_t bytes_ = 0;
  std::optional<Vector<std::byte>> staging_;  // for writes if buffers cannot be mapped
};

// Copies bytes of a buffer to `out` and waits for the GPU. Binds GL_ARRAY_BUFFER. Throws Failure if the
// buffer cannot be mapped and OpenGL has no other way.
void read_buffer_bytes(const Device& device, GLuint buffer, std::uint64_t offset, std::uint64_t bytes,
                       void* out);

// Any other kind of object. One owner type is enough, since kinds differ only in the call that deletes them.
class Object {
 public:
  using Kind = ObjectKind;

  Object() = default;
  // Takes over a name. Throws std::bad_alloc, and the name is deleted then.
  Object(Device& device, Kind kind, GLuint name) : kind_(kind), name_(name) {
    device.adopt(kind, name);
    device_ = &device;
  }
  static Object make(Device& device, Kind kind);
  Object(Object&& other) noexcept { swap(other); }
  Object& operator=(Object&& other) noexcept {
    Object old(std::move(other));
    swap(old);
    return *this;
  }
  ~Object();

  GLuint name() const { return name_; }

 private:
  void swap(Object& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(kind_, other.kind_);
    std::swap(name_, other.name_);
  }

  Device* device_ = nullptr;
  Kind kind_ = Kind::texture;
  GLuint name_ = 0;
};

// A draw needs a complete framebuffer even if nothing is rasterised, and a surfaceless context has none.
class FeedbackTarget {
 public:
  FeedbackTarget() = default;
  // Binds GL_DRAW_FRAMEBUFFER and GL_RENDERBUFFER. Throws Failure.
  explicit FeedbackTarget(Device& device);

  // begin binds the framebuffer and the transform-feedback object, and turns rasterization and primitive
  // restart off. end turns rasterization on, and unbinds the written buffer.
  void begin(const Device& device) const;
  static void end(const Device& device);

 private:
  Object framebuffer_, renderbuffer_;
  Object feedback_;  // name 0 before OpenGL 4.0
};

}  // namespace nook::gl
