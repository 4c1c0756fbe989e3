#include "sdk/src/gl/probe/capture.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/functions.h"

namespace nook::gl {
namespace {

// Clears the error that OpenGL reports if it rejects a bind.
void clear_refusal(const Functions& gl) {
  for (int i = 0; i < 16; ++i)
    if (gl.GetError() == GL_NO_ERROR) return;
}

GLint parameter(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetTexParameteriv(GL_TEXTURE_CUBE_MAP, name, &value);
  return value;
}

void check_levels(const Functions& gl, const CubeMap& cube) {
  const GLint base = parameter(gl, GL_TEXTURE_BASE_LEVEL), last = parameter(gl, GL_TEXTURE_MAX_LEVEL);
  if (base != 0 || last < GLint(cube.level))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "cube_map %u lacks a level (got levels %d to %d, need levels 0 to %u, which is desc.level, or more)",
        cube.name, base, last, cube.level);
}

void check_face(const Functions& gl, const CubeMap& cube, GLenum face) {
  const auto level = [&](GLenum what) {
    GLint value = 0;
    gl.GetTexLevelParameteriv(face, GLint(cube.level), what, &value);
    return value;
  };
  const GLint width = level(GL_TEXTURE_WIDTH), height = level(GL_TEXTURE_HEIGHT),
              size = GLint(cube.face_size_px);
  if (width != size || height != size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "cube_map %u has another size (got %d x %d on face %u of level %u, need "
                  "desc.face_size_px, %d)",
                  cube.name, width, height, face - GL_TEXTURE_CUBE_MAP_POSITIVE_X, cube.level, size);
  for (const GLenum channel : {GL_TEXTURE_RED_TYPE, GL_TEXTURE_GREEN_TYPE, GL_TEXTURE_BLUE_TYPE}) {
    const GLint type = level(channel);
    if (type != GL_FLOAT && type != GL_UNSIGNED_NORMALIZED && type != GL_SIGNED_NORMALIZED)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "cube_map %u has a format that does not fit (got 0x%04x, need red, green and blue in "
                    "floats or normalised integers, such as GL_RGBA16F)",
                    cube.name, static_cast<unsigned>(level(GL_TEXTURE_INTERNAL_FORMAT)));
  }
}

}  // namespace

void bind_checked(const Device& device, const CubeMap& cube) {
  const Functions& gl = device.gl;
  if (!gl.IsTexture(cube.name))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "cube_map is not a texture of this OpenGL context (got %u, need the name of a GL_TEXTURE_CUBE_MAP)",
        cube.name);
  gl.BindTexture(GL_TEXTURE_CUBE_MAP, cube.name);
  if (GLuint(integer(gl, GL_TEXTURE_BINDING_CUBE_MAP)) != cube.name) {
    clear_refusal(gl);
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "cube_map is a texture of another kind (got %u, need a GL_TEXTURE_CUBE_MAP)", cube.name);
  }
  check_levels(gl, cube);
  if (!gl.can.texture_sizes) return;
  for (GLenum face = 0; face < 6; ++face) check_face(gl, cube, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face);
}

}  // namespace nook::gl
