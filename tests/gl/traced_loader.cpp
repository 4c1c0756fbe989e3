#include "tests/gl/traced_loader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "sdk/src/gl/functions.h"

namespace nook::test {
namespace {

enum Id {
#define NOOK_X(name) id_##name,
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
      id_count
};

constexpr const char* names[] = {
#define NOOK_X(name) "gl" #name,
    NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
};

struct Counts {
  std::array<int, id_count> calls{};
  bool mapped_for_reading = false;
  bool writing = false;  // the last map
  Trace* trace = nullptr;
};
Counts counts;

template <Id id, class F>
struct Traced;
template <Id id, class R, class... A>
struct Traced<id, R(GLAD_API_PTR*)(A...)> {
  inline static R(GLAD_API_PTR* real)(A...) = nullptr;
  static R GLAD_API_PTR call(A... a) {
    ++counts.calls[id];
    if constexpr (id == id_MapBufferRange) {
      const auto access = std::get<3>(std::tuple(a...));
      counts.mapped_for_reading |= (access & GL_MAP_READ_BIT) != 0;
      counts.writing = (access & GL_MAP_WRITE_BIT) != 0;
      if (counts.trace->mapping_fails && counts.writing) return nullptr;
    }
    if constexpr (id == id_UnmapBuffer) {
      if (counts.writing && counts.trace->unmapping_fails()) {
        real(a...);
        counts.trace->lose_array_buffer();
        return GL_FALSE;
      }
    }
    if constexpr (id == id_GetString) {
      if (counts.trace->version && std::get<0>(std::tuple(a...)) == GL_VERSION)
        return reinterpret_cast<const GLubyte*>(counts.trace->version);
    }
    if constexpr (id == id_GetShaderiv) {
      if (counts.trace->shaders_fail) {
        *std::get<2>(std::tuple(a...)) = GL_FALSE;
        return;
      }
    }
    if constexpr (id == id_GetIntegerv) {
      const auto [name, out] = std::tuple(a...);
      const auto limit = counts.trace->limits.find(name);
      if (limit != counts.trace->limits.end()) {
        *out = limit->second;
        return;
      }
      if (name == GL_COMPRESSED_TEXTURE_FORMATS &&
          counts.trace->limits.contains(GL_NUM_COMPRESSED_TEXTURE_FORMATS)) {
        std::copy(counts.trace->formats.begin(), counts.trace->formats.end(), out);
        return;
      }
    }
    return real(a...);
  }
};

}  // namespace

Trace::Trace(platform::Context& context) : context_(context) {
  counts = {};
  counts.trace = this;
}

Trace::~Trace() {
  counts.trace = nullptr;
}

bool Trace::unmapping_fails() {
  return unmapping_failures > 0 && unmappings_++ % (unmapping_failures + 1) < unmapping_failures;
}

void Trace::lose_array_buffer() {
  const GladGLContext& gl = context_.gl();
  GLint bytes = 0;
  gl.GetBufferParameteriv(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &bytes);
  const std::vector<std::uint8_t> garbage(static_cast<std::size_t>(bytes), 0x7f);
  gl.BufferSubData(GL_ARRAY_BUFFER, 0, bytes, garbage.data());
}

void* Trace::loader(void* user, const char* name) {
  Trace& trace = *static_cast<Trace*>(user);
  trace.asked.insert(name);
  if (trace.hidden.contains(name)) return nullptr;
  void* const real = trace.context_.proc(name);
  if (!real) return nullptr;
#define NOOK_X(function)                                                 \
  if (std::strcmp(name, "gl" #function) == 0) {                          \
    using T = Traced<id_##function, decltype(gl::Functions::function)>;  \
    T::real = reinterpret_cast<decltype(gl::Functions::function)>(real); \
    return reinterpret_cast<void*>(&T::call);                            \
  }
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
  return real;
}

void Trace::reset() {
  counts.calls = {};
  counts.mapped_for_reading = false;
}

int Trace::calls(const std::string& name) const {
  return calls_that_begin(name);
}

int Trace::calls_that_begin(const std::string& prefix) const {
  int sum = 0;
  for (int i = 0; i < id_count; ++i)
    if (std::string(names[i]).starts_with(prefix)) sum += counts.calls[i];
  return sum;
}

std::set<std::string> Trace::forbidden_in_frame(bool preserves_state) const {
  std::vector<std::string> prefixes = {"glGen", "glGetError", "glGetBufferSubData", "glFinish",
                                       "glClientWaitSync"};
  if (!preserves_state) prefixes.insert(prefixes.end(), {"glGet", "glIs"});
  std::set<std::string> out;
  for (int i = 0; i < id_count; ++i) {
    const auto begins = [&](const std::string& prefix) { return std::string(names[i]).starts_with(prefix); };
    if (counts.calls[i] > 0 && std::any_of(prefixes.begin(), prefixes.end(), begins)) out.insert(names[i]);
  }
  if (mapped_for_reading()) out.insert("glMapBufferRange for reading");
  return out;
}

bool Trace::mapped_for_reading() const {
  return counts.mapped_for_reading;
}

}  // namespace nook::test
