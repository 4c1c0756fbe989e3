#include "gpu_program.h"

#include <stdexcept>
#include <string>

namespace crowd {
namespace {

GLuint compile(const GladGLContext& gl, GLenum kind, const char* source) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[2048] = "";
  gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl.DeleteShader(shader);
  throw std::runtime_error(std::string("crowd: a shader does not compile: ") + log);
}

}  // namespace

GpuProgram::GpuProgram(const GladGLContext& gl, const char* vertex_source, const char* fragment_source)
    : gl_(gl) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
  name_ = gl.CreateProgram();
  gl.AttachShader(name_, vertex);
  gl.AttachShader(name_, fragment);
  gl.LinkProgram(name_);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked) return;
  char log[2048] = "";
  gl.GetProgramInfoLog(name_, sizeof log, nullptr, log);
  gl.DeleteProgram(name_);
  throw std::runtime_error(std::string("crowd: a program does not link: ") + log);
}

GpuProgram::~GpuProgram() {
  gl_.DeleteProgram(name_);
}

}  // namespace crowd
