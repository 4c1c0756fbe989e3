// A loader that stands between Nook and the driver: counts every call by name, hides functions, and lowers
// limits.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "platform/platform.h"

namespace nook::test {

// The counts are of the process, since OpenGL functions carry no user pointer; one Trace is alive at a time.
class Trace {
 public:
  explicit Trace(platform::Context& context);
  ~Trace();
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  // For nook_gl_desc.get_proc, with the Trace as user.
  static void* loader(void* user, const char* name);

  std::set<std::string> hidden;    // these names are answered with NULL
  std::map<unsigned, int> limits;  // what glGetIntegerv answers for these names
  std::vector<int> formats;        // and for GL_COMPRESSED_TEXTURE_FORMATS, if `limits` has their number
  const char* version = nullptr;   // what glGetString answers for GL_VERSION, unless null
  bool shaders_fail = false;       // by glGetShaderiv
  bool mapping_fails = false;      // glMapBufferRange answers NULL for writing
  // So many calls of glUnmapBuffer after writing lose the contents and answer GL_FALSE before one keeps them.
  int unmapping_failures = 0;

  void reset();
  int calls(const std::string& name) const;  // "glMapBufferRange"
  int calls_that_begin(const std::string& prefix) const;
  bool mapped_for_reading() const;
  // Returns the functions called since reset() that no frame may call, because they make objects, wait for
  // the GPU or read back. Unless Nook preserves the state, functions that query it count too.
  std::set<std::string> forbidden_in_frame(bool preserves_state) const;
  std::set<std::string> asked;  // every name that the loader has looked up

  // Overwrites the buffer that is bound to GL_ARRAY_BUFFER.
  void lose_array_buffer();
  // Returns whether this call of glUnmapBuffer fails.
  bool unmapping_fails();

 private:
  platform::Context& context_;
  int unmappings_ = 0;
};

}  // namespace nook::test
