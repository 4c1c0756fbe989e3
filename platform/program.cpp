#include "platform/program.h"

#include <stdexcept>
#include <string>

namespace platform {
namespace {

void attach(const GladGLContext& gl, GLuint program, GLenum stage, std::initializer_list<const char*> texts) {
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, GLsizei(texts.size()), texts.begin(), nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  char log[2048] = "";
  if (!compiled) gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);  // deleted with the program that it is attached to
  if (!compiled) throw std::runtime_error(std::string("a shader does not compile: ") + log);
}

void link(const GladGLContext& gl, GLuint program) {
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return;
  char log[2048] = "";
  gl.GetProgramInfoLog(program, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("a program does not link: ") + log);
}

}  // namespace

GLuint link_program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                    std::initializer_list<const char*> fragment) {
  const GLuint program = gl.CreateProgram();
  try {
    attach(gl, program, GL_VERTEX_SHADER, vertex);
    attach(gl, program, GL_FRAGMENT_SHADER, fragment);
    link(gl, program);
  } catch (...) {
    gl.DeleteProgram(program);
    throw;
  }
  return program;
}

}  // namespace platform
