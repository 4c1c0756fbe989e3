// The state that all OpenGL objects of one nook_gl share: functions, limits, and the amount of memory in use.
#pragma once

#include <nook/nook_gl.h>

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/context.h"
#include "sdk/src/gl/functions.h"

namespace nook::gl {

enum class ObjectKind {
  buffer,
  framebuffer,
  renderbuffer,
  texture,
  sampler,
  query,
  vertex_array,
  transform_feedback,
  program,
  shader
};

struct Device {
  // Reads the limits of the OpenGL context, which must be current. Throws Failure.
  Device(Context& host, const nook_gl_desc& desc);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device();

  // Logs and clears errors that the host's OpenGL calls have caused. After that, errors can only come from
  // Nook's calls.
  void report_host_errors() const;
  // Throws Failure if OpenGL has reported an error. `what` is the action that failed, for the message.
  void check(const char* what) const;
  // While an object of this type exists, the two functions above do nothing unless `debug` is set, because
  // querying an error may wait for the driver.
  class Unchecked {
   public:
    explicit Unchecked(Device& device) : device_(device) { ++device_.unchecked_; }
    ~Unchecked() { --device_.unchecked_; }
    Unchecked(const Unchecked&) = delete;
    Unchecked& operator=(const Unchecked&) = delete;

   private:
    Device& device_;
  };
  // Throws Failure if the OpenGL context was lost. Also calls need_current.
  void need_alive() const;
  // If nook_gl_desc.debug is set, throws Failure unless the OpenGL context that was current in nook_gl_create
  // is current.
  void need_current() const;
  // Returns whether objects may be deleted in the current context. If another context is current, the objects
  // must not be deleted. They leak, and a message in the log reports this once.
  bool may_delete() const;
  // Call adopt for every OpenGL name that Nook creates, and remove for every name that it deletes. While a
  // call holds a StateGuard, remove defers the deletion until the host's state is restored. At that time,
  // deleting the object also removes the bindings that the host has made to it. If the object were deleted
  // earlier, the guard would try to restore bindings to an object that no longer exists. adopt reserves the
  // memory that remove needs, so that removing never allocates. If adopt cannot reserve this memory, it
  // deletes the name and throws std::bad_alloc.
  void adopt(ObjectKind kind, GLuint name);
  void remove(ObjectKind kind, GLuint name) noexcept;
  void begin_call() { ++calls_; }
  void end_call() noexcept;
  void label(GLenum kind, GLuint name, const char* text) const {
    if (gl.ObjectLabel) gl.ObjectLabel(kind, name, -1, text);
  }

  const Context& context;
  Memory* const memory;
  const Functions gl;
  const nook_gl_state_mode state_mode;
  const bool debug;
  bool lost = false;  // OpenGL must not be called any more
  std::uint64_t buffer_bytes = 0;
  std::uint64_t ao_bytes = 0;

  // The maximum size of a buffer range that is bound at once: the limit of the context, but at most 128 MiB.
  std::uint64_t max_piece_bytes = std::uint64_t{128} << 20;
  std::uint64_t storage_alignment = 256;  // bytes
  std::uint32_t max_texels = 65536;       // maximum number of texels in a table of texels

 private:
  void read_limits();
  void mark_context();
  // Returns a text that says what is wrong with the current context, or null.
  const char* context_fault() const;
  GLuint mark() const;
  void delete_now(ObjectKind kind, GLuint name) const;

  struct Removed {
    ObjectKind kind;
    GLuint name;
  };
  Vector<Removed> removed_;  // has reserved memory for all adopted objects
  std::size_t object_count_ = 0;
  int calls_ = 0;  // number of calls that hold a StateGuard
  int unchecked_ = 0;

  // A vertex array that stores a unique number. Contexts do not share vertex arrays, so the number identifies
  // this context.
  GLuint marked_array_ = 0;
  mutable bool told_objects_left_ = false;
};

}  // namespace nook::gl
