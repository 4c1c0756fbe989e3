#include "tests/bench/gl_stub.h"

#include <cstring>
#include <memory>
#include <string_view>

#include "sdk/src/gl/functions.h"

namespace nook::bench {
namespace {

// Answers zero, or nothing, to everything.
template <class F>
struct Nothing;
template <class R, class... A>
struct Nothing<R(GLAD_API_PTR*)(A...)> {
  static R GLAD_API_PTR call(A...) { return R(); }
};

const GLubyte* GLAD_API_PTR get_string(GLenum) {
  return reinterpret_cast<const GLubyte*>("4.5.0 stub");
}

void GLAD_API_PTR get_integer(GLenum name, GLint* out) {
  switch (name) {
    case GL_MAJOR_VERSION:
      *out = 4;
      break;
    case GL_MINOR_VERSION:
      *out = 5;
      break;
    case GL_MAX_SHADER_STORAGE_BLOCK_SIZE:
      *out = 1 << 27;
      break;
    case GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT:
      *out = 256;
      break;
    case GL_MAX_TEXTURE_BUFFER_SIZE:
    case GL_MAX_TEXTURE_SIZE:
      *out = 1 << 27;
      break;
    default:
      *out = 0;
  }
}

// OpenGL functions carry no pointer of the caller's, so the names and the memory are of the process.
GLuint next_name() {
  static GLuint last = 0;
  return ++last;
}

void GLAD_API_PTR gen(GLsizei count, GLuint* names) {
  for (GLsizei i = 0; i < count; ++i) names[i] = next_name();
}
GLuint GLAD_API_PTR create_program() {
  return next_name();
}
GLuint GLAD_API_PTR create_shader(GLenum) {
  return next_name();
}
void GLAD_API_PTR succeeds(GLuint, GLenum, GLint* out) {
  *out = GL_TRUE;
}
GLboolean GLAD_API_PTR unmap(GLenum) {
  return GL_TRUE;
}
GLenum GLAD_API_PTR complete(GLenum) {
  return GL_FRAMEBUFFER_COMPLETE;
}

void* GLAD_API_PTR map(GLenum, GLintptr, GLsizeiptr bytes, GLbitfield) {
  static std::unique_ptr<unsigned char[]> memory;
  static GLsizeiptr room = 0;
  if (bytes > room) {
    memory.reset(new unsigned char[static_cast<std::size_t>(bytes)]);
    room = bytes;
  }
  return memory.get();
}

template <class F>
void* address(F function) {
  return reinterpret_cast<void*>(function);
}

}  // namespace

void* stub_loader(void*, const char* name) {
  const std::string_view wanted = name;
  if (wanted == "glGetString") return address(get_string);
  if (wanted == "glGetIntegerv") return address(get_integer);
  if (wanted.starts_with("glGen") && wanted != "glGenerateMipmap") return address(gen);
  if (wanted == "glCreateProgram") return address(create_program);
  if (wanted == "glCreateShader") return address(create_shader);
  if (wanted == "glGetShaderiv" || wanted == "glGetProgramiv") return address(succeeds);
  if (wanted == "glMapBufferRange") return address(map);
  if (wanted == "glUnmapBuffer") return address(unmap);
  if (wanted == "glCheckFramebufferStatus") return address(complete);
#define NOOK_X(function) \
  if (wanted == "gl" #function) return address(Nothing<decltype(GladGLContext::function)>::call);
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
  return nullptr;
}

}  // namespace nook::bench
