// Owners of OpenGL objects: buffers, other objects, and the objects for transform feedback. The destructor of
// an owner deletes its OpenGL name, or only forgets the name if the OpenGL context was lost.
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
  // Binds GL_ARRAY_BUFFER, as all writing functions of this class do. If `data` is NULL, the contents are
  // undefined. Throws Failure.
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
  // Replaces the contents: fill(memory) must write `bytes` bytes. If the GPU is still reading the old
  // contents, it gets them unchanged. The call does not wait for the GPU, with one exception: if a texture
  // reads the buffer, NVIDIA's driver waits for the GPU in the map call. OpenGL may lose the written
  // contents, for example when the display mode changes. In this case, fill is called again. Throws Failure
  // if OpenGL is out of memory or loses the contents repeatedly.
  template <class Fill>
  void write(std::uint64_t bytes, Fill&& fill) {
    for (int attempt = 0; attempt < max_write_attempts; ++attempt) {
      fill(begin_write(bytes));
      if (end_write()) return;
    }
    fail_write(bytes);
  }
  // Replaces the contents by the caller's memory. Use it for buffers that a texture reads, because NVIDIA's
  // driver does not wait here. The call does not report failures, because it does not query OpenGL errors, to
  // keep updates fast. If it fails, the host finds the error when it queries OpenGL errors itself.
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
  std::optional<Vector<std::byte>> staging_;  // memory for writes if buffers cannot be mapped
};

// Copies bytes of a buffer to `out`. Waits for the GPU. Binds GL_ARRAY_BUFFER. Throws Failure if OpenGL has
// no function to read buffers and mapping the buffer fails.
void read_buffer_bytes(const Device& device, GLuint buffer, std::uint64_t offset, std::uint64_t bytes,
                       void* out);

// Owns any other kind of object. One class is enough, because kinds differ only in the function that deletes
// them.
class Object {
 public:
  using Kind = ObjectKind;

  Object() = default;
  // Takes ownership of a name. If the constructor throws std::bad_alloc, it has already deleted the name.
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

// A framebuffer and a transform-feedback object for draws that rasterise nothing. OpenGL requires a complete
// framebuffer even then, and a surfaceless context does not have one.
class FeedbackTarget {
 public:
  FeedbackTarget() = default;
  // Binds GL_DRAW_FRAMEBUFFER and GL_RENDERBUFFER. Throws Failure.
  explicit FeedbackTarget(Device& device);

  // begin binds the framebuffer and the transform-feedback object, and disables rasterization and primitive
  // restart. end enables rasterization, and unbinds the buffer that was written.
  void begin(const Device& device) const;
  static void end(const Device& device);

 private:
  Object framebuffer_, renderbuffer_;
  Object feedback_;  // its name is 0 if OpenGL is older than 4.0
};

}  // namespace nook::gl
