#include "sdk/src/gl/shader_program.h"

#include <cstring>
#include <initializer_list>
#include <iterator>

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

const char* version_line(const Functions& gl, GLenum stage, ShaderNeeds needs) {
  const bool compute = stage == GL_COMPUTE_SHADER;
  if (gl.profile == Profile::desktop)
    return compute || needs.gathers ? "#version 430 core\n" : "#version 330 core\n";
  if (needs.sample_arrays) return "#version 320 es\n";
  return compute || needs.sample_textures || needs.gathers ? "#version 310 es\n" : "#version 300 es\n";
}

// Every stage uses high precision on OpenGL ES too, unless measurements have shown that medium precision is
// enough. Depths, and sums over taps and spheres, need high precision.
const char* float_precision(const Functions& gl, ShaderNeeds needs) {
  if (gl.profile == Profile::desktop) return "";
  return needs.medium_precision ? "precision mediump float;\n" : "precision highp float;\n";
}

constexpr const char* common_precisions =
    "precision highp int;\nprecision highp sampler2D;\nprecision highp usampler2D;\n"
    "precision highp sampler2DArray;\n";

const char* sample_precisions(ShaderNeeds needs) {
  if (needs.sample_arrays) return "precision highp sampler2DMS;\nprecision highp sampler2DMSArray;\n";
  return needs.sample_textures ? "precision highp sampler2DMS;\n" : "";
}

Object compile(Device& device, GLenum stage, const char* path, const char* defines, ShaderNeeds needs = {}) {
  const Functions& gl = device.gl;
  const bool es = gl.profile != Profile::desktop;
  Object shader(device, Object::Kind::shader, gl.CreateShader(stage));
  const char* parts[] = {version_line(gl, stage, needs),
                         float_precision(gl, needs),
                         es ? common_precisions : "",
                         es ? sample_precisions(needs) : "",
                         es && stage == GL_COMPUTE_SHADER ? "precision highp image2D;\n" : "",
                         defines,
                         "#line 1\n",
                         embedded_text(path)};
  gl.ShaderSource(shader.name(), GLsizei(std::size(parts)), parts, nullptr);
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

Object compute_program(Device& device, const char* path, const char* defines, ShaderNeeds needs) {
  const Object shader = compile(device, GL_COMPUTE_SHADER, path, defines, needs);
  return link(device, {shader.name()}, path, nullptr);
}

Object feedback_program(Device& device, const char* path, const char* defines, const char* varying) {
  const Object vertex = compile(device, GL_VERTEX_SHADER, path, defines);
  if (device.gl.profile == Profile::desktop) return link(device, {vertex.name()}, path, varying);
  // OpenGL ES cannot link a program without a fragment shader.
  const Object fragment = compile(device, GL_FRAGMENT_SHADER, "core/nothing.frag", "");
  return link(device, {vertex.name(), fragment.name()}, path, varying);
}

Object draw_program(Device& device, const char* vertex_path, const char* fragment_path, const char* defines,
                    ShaderNeeds needs) {
  const Object vertex = compile(device, GL_VERTEX_SHADER, vertex_path, "",
                                {.sample_textures = needs.sample_textures,
                                 .sample_arrays = needs.sample_arrays,
                                 .gathers = needs.gathers});
  const Object fragment = compile(device, GL_FRAGMENT_SHADER, fragment_path, defines, needs);
  return link(device, {vertex.name(), fragment.name()}, fragment_path, nullptr);
}

GLint uniform_location(const Device& device, const Object& program, const char* name) {
  return device.gl.GetUniformLocation(program.name(), name);
}

}  // namespace nook::gl
