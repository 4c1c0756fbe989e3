#include "sdk/src/gl/program.h"

#include <cstring>
#include <initializer_list>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/embedded_shaders.h"

namespace nook::gl {

const char* embedded_text(const char* path) {
  for (const EmbeddedShader* shader = embedded_shaders_begin(); shader != embedded_shaders_end(); ++shader)
    if (std::strcmp(shader->path, path) == 0) return shader->text;
  throw Failure(NOOK_ERROR_INTERNAL, "the library holds no shader %s; please report it", path);
}

namespace {

struct InfoLog {
  char text[2048] = "";
};

[[noreturn]] void fail(const Device& device, const char* step, const char* path, const InfoLog& log) {
  device.context.log(NOOK_LOG_ERROR, "nook_gl: %s %s: %s", step, path, log.text);
  throw Failure(NOOK_ERROR_GL, "%s %s failed: %.300s; please report it with the driver's version", step, path,
                log.text);
}

Object compile(Device& device, GLenum stage, const char* path, const char* version, const char* defines) {
  const Functions& gl = device.gl;
  Object shader(device, Object::Kind::shader, gl.CreateShader(stage));
  const char* parts[] = {version, defines, "#line 1\n", embedded_text(path)};
  gl.ShaderSource(shader.name(), 4, parts, nullptr);
  gl.CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    InfoLog log;
    gl.GetShaderInfoLog(shader.name(), sizeof log.text, nullptr, log.text);
    fail(device, "compiling", path, log);
  }
  return shader;
}

Object link(Device& device, std::initializer_list<GLuint> shaders, const char* path, const char* varying) {
  const Functions& gl = device.gl;
  Object program = Object::make(device, Object::Kind::program);
  for (const GLuint shader : shaders) gl.AttachShader(program.name(), shader);
  if (varying) gl.TransformFeedbackVaryings(program.name(), 1, &varying, GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(program.name());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (!linked) {
    InfoLog log;
    gl.GetProgramInfoLog(program.name(), sizeof log.text, nullptr, log.text);
    fail(device, "linking", path, log);
  }
  for (const GLuint shader : shaders) gl.DetachShader(program.name(), shader);
  device.label(GL_PROGRAM, program.name(), path);
  return program;
}

}  // namespace

Object compute_program(Device& device, const char* path, const char* defines) {
  const Object shader = compile(device, GL_COMPUTE_SHADER, path, "#version 430 core\n", defines);
  return link(device, {shader.name()}, path, nullptr);
}

Object feedback_program(Device& device, const char* path, const char* defines, const char* varying) {
  const Object shader = compile(device, GL_VERTEX_SHADER, path, "#version 330 core\n", defines);
  return link(device, {shader.name()}, path, varying);
}

Object draw_program(Device& device, const char* vertex_path, const char* fragment_path, const char* defines) {
  const char* const version = "#version 330 core\n";
  const Object vertex = compile(device, GL_VERTEX_SHADER, vertex_path, version, "");
  const Object fragment = compile(device, GL_FRAGMENT_SHADER, fragment_path, version, defines);
  return link(device, {vertex.name(), fragment.name()}, fragment_path, nullptr);
}

GLint uniform_location(const Device& device, const Object& program, const char* name) {
  return device.gl.GetUniformLocation(program.name(), name);
}

}  // namespace nook::gl
