#include "platform/program.h"

#include <stdexcept>
#include <string>
#include <utility>

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
  gl.DeleteShader(shader);  // OpenGL deletes the shader together with its program
  if (!compiled) throw std::runtime_error(std::string("link_program: a shader does not compile: ") + log);
}

void link(const GladGLContext& gl, GLuint program) {
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return;
  char log[2048] = "";
  gl.GetProgramInfoLog(program, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("link_program: a program does not link: ") + log);
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

Program::Program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                 std::initializer_list<const char*> fragment)
    : gl_(gl), name_(link_program(gl, vertex, fragment)) {}

Program::Program(Program&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}

Program::~Program() {
  gl_.DeleteProgram(name_);
}

}  // namespace platform
