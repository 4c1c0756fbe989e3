#include "tests/fuzz/silent_gl.h"

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <tuple>
#include <vector>

#include "sdk/src/gl/functions.h"

namespace nook::test {
namespace {

struct State {
  SilentGl shape;
  GLuint last_name = 0;
  std::map<GLenum, GLuint> bound_buffer;
  std::map<GLuint, std::vector<std::byte>> buffer;
  std::vector<std::byte> mapped;
  GLuint bound_texture_2d = 0;
};

// Left to the end of the process: handles of the library may be destroyed after every static object here.
State& state() {
  static State* const made = new State;
  return *made;
}

std::vector<std::byte>& bound_store(GLenum target) {
  return state().buffer[state().bound_buffer[target]];
}

void need_inside(GLenum target, GLintptr offset, GLsizeiptr size) {
  if (offset < 0 || size < 0 || std::size_t(offset) + std::size_t(size) > bound_store(target).size())
    std::abort();
}

std::size_t channels_of(GLenum format) {
  switch (format) {
    case GL_RGBA:
    case GL_RGBA_INTEGER:
      return 4;
    case GL_RGB:
      return 3;
    case GL_RG:
      return 2;
    default:
      return 1;
  }
}

std::size_t bytes_of(GLenum type) {
  if (type == GL_FLOAT || type == GL_UNSIGNED_INT) return 4;
  return type == GL_HALF_FLOAT || type == GL_UNSIGNED_SHORT ? 2 : 1;
}

// The copy is what the address sanitizer checks.
void read_texels(GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type, const void* data) {
  const std::size_t bytes =
      std::size_t(width) * std::size_t(height) * std::size_t(depth) * channels_of(format) * bytes_of(type);
  const auto* first = static_cast<const std::byte*>(data);
  if (data) std::vector<std::byte>(first, first + bytes).swap(state().mapped);
}

GLint limit_of(GLenum name) {
  switch (name) {
    case GL_MAJOR_VERSION:
      return state().shape.version / 10;
    case GL_MINOR_VERSION:
      return state().shape.version % 10;
    case GL_MAX_TEXTURE_SIZE:
      return 16384;
    case GL_MAX_ARRAY_TEXTURE_LAYERS:
      return 256;
    case GL_MAX_TEXTURE_BUFFER_SIZE:
      return 1 << 20;
    case GL_MAX_SHADER_STORAGE_BLOCK_SIZE:
      return 1 << 27;
    case GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT:
      return 256;
    case GL_TEXTURE_BINDING_2D:
      return GLint(state().bound_texture_2d);
    case GL_ACTIVE_TEXTURE:
      return GL_TEXTURE0;
    case GL_DRAW_BUFFER0:
      return GL_COLOR_ATTACHMENT0;
    default:
      return name >= GL_MAX_COMPUTE_WORK_GROUP_COUNT ? 0 : 16;
  }
}

GLint level_value(GLenum name) {
  switch (name) {
    case GL_TEXTURE_WIDTH:
      return state().shape.width;
    case GL_TEXTURE_HEIGHT:
      return state().shape.height;
    case GL_TEXTURE_RED_TYPE:
    case GL_TEXTURE_GREEN_TYPE:
    case GL_TEXTURE_BLUE_TYPE:
      return GL_FLOAT;
    case GL_TEXTURE_DEPTH_SIZE:
      return state().shape.depth_bits;
    default:
      return 32;
  }
}

enum Id {
#define NOOK_X(name) id_##name,
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
};

constexpr bool makes_names(Id id) {
  return id == id_GenBuffers || id == id_GenFramebuffers || id == id_GenQueries ||
         id == id_GenRenderbuffers || id == id_GenSamplers || id == id_GenTextures ||
         id == id_GenTransformFeedbacks || id == id_GenVertexArrays;
}

// 0, or what the library must see so that it goes on.
template <Id id, class F>
struct Silent;
template <Id id, class R, class... A>
struct Silent<id, R(GLAD_API_PTR*)(A...)> {
  static R GLAD_API_PTR call(A... a) {
    [[maybe_unused]] const std::tuple arguments(a...);
    [[maybe_unused]] State& s = state();
    if constexpr (makes_names(id)) {
      for (GLsizei i = 0; i < std::get<0>(arguments); ++i) std::get<1>(arguments)[i] = ++s.last_name;
    } else if constexpr (id == id_CreateProgram || id == id_CreateShader) {
      return ++s.last_name;
    } else if constexpr (id == id_GetString) {
      return reinterpret_cast<const GLubyte*>("silent");
    } else if constexpr (id == id_GetIntegerv) {
      *std::get<1>(arguments) = limit_of(std::get<0>(arguments));
    } else if constexpr (id == id_GetShaderiv || id == id_GetProgramiv) {
      *std::get<2>(arguments) = GL_TRUE;
    } else if constexpr (id == id_CheckFramebufferStatus) {
      return GL_FRAMEBUFFER_COMPLETE;
    } else if constexpr (id == id_ClientWaitSync) {
      return GL_ALREADY_SIGNALED;
    } else if constexpr (id == id_IsTexture || id == id_IsFramebuffer || id == id_IsProgram ||
                         id == id_UnmapBuffer) {
      return GL_TRUE;
    } else if constexpr (id == id_GetTexLevelParameteriv) {
      *std::get<3>(arguments) = level_value(std::get<2>(arguments));
    } else if constexpr (id == id_GetTexParameteriv) {
      *std::get<2>(arguments) =
          std::get<1>(arguments) == GL_DEPTH_STENCIL_TEXTURE_MODE ? GL_DEPTH_COMPONENT : 0;
    } else if constexpr (id == id_GetFramebufferAttachmentParameteriv) {
      *std::get<3>(arguments) = 0;
    } else if constexpr (id == id_GetQueryObjectui64v || id == id_GetInteger64i_v || id == id_GetIntegeri_v) {
      *std::get<2>(arguments) = 0;
    } else if constexpr (id == id_BindTexture) {
      if (std::get<0>(arguments) == GL_TEXTURE_2D) s.bound_texture_2d = std::get<1>(arguments);
    } else if constexpr (id == id_BindBuffer) {
      s.bound_buffer[std::get<0>(arguments)] = std::get<1>(arguments);
    } else if constexpr (id == id_BindBufferBase || id == id_BindBufferRange) {
      s.bound_buffer[std::get<0>(arguments)] = std::get<2>(arguments);
      if constexpr (id == id_BindBufferRange)
        need_inside(std::get<0>(arguments), std::get<3>(arguments), std::get<4>(arguments));
    } else if constexpr (id == id_DeleteBuffers) {
      for (GLsizei i = 0; i < std::get<0>(arguments); ++i) s.buffer.erase(std::get<1>(arguments)[i]);
    } else if constexpr (id == id_BufferData) {
      const auto [target, size, data, usage] = arguments;
      const auto* first = static_cast<const std::byte*>(data);
      std::vector<std::byte> store(static_cast<std::size_t>(size));
      if (data) store.assign(first, first + size);
      bound_store(target).swap(store);
    } else if constexpr (id == id_BufferSubData) {
      const auto [target, offset, size, data] = arguments;
      need_inside(target, offset, size);
      if (size > 0) std::memcpy(bound_store(target).data() + offset, data, std::size_t(size));
    } else if constexpr (id == id_GetBufferSubData) {
      const auto [target, offset, size, data] = arguments;
      need_inside(target, offset, size);
      if (size > 0) std::memset(data, 0, std::size_t(size));
    } else if constexpr (id == id_MapBufferRange) {
      need_inside(std::get<0>(arguments), std::get<1>(arguments), std::get<2>(arguments));
      std::vector<std::byte>(static_cast<std::size_t>(std::get<2>(arguments))).swap(s.mapped);
      return s.mapped.data();
    } else if constexpr (id == id_ReadPixels) {
      const auto [x, y, width, height, format, type, data] = arguments;
      std::memset(data, 0, std::size_t(width) * std::size_t(height) * channels_of(format) * bytes_of(type));
    } else if constexpr (id == id_TexImage2D) {
      const auto [target, level, internal, width, height, border, format, type, data] = arguments;
      read_texels(width, height, 1, format, type, data);
    } else if constexpr (id == id_TexImage3D) {
      const auto [target, level, internal, width, height, depth, border, format, type, data] = arguments;
      read_texels(width, height, depth, format, type, data);
    } else if constexpr (id == id_CompressedTexImage3D) {
      const auto [target, level, internal, width, height, depth, border, bytes, data] = arguments;
      const auto* first = static_cast<const std::byte*>(data);
      std::vector<std::byte>(first, first + bytes).swap(s.mapped);
    }
    return R();
  }
};

}  // namespace

SilentGl& silent_gl() {
  return state().shape;
}

void* silent_gl_proc(void*, const char* name) {
#define NOOK_X(function)                      \
  if (std::strcmp(name, "gl" #function) == 0) \
    return reinterpret_cast<void*>(&Silent<id_##function, decltype(gl::Functions::function)>::call);
  NOOK_GL_FUNCTIONS_ALL(NOOK_X)
#undef NOOK_X
  return nullptr;
}

}  // namespace nook::test
