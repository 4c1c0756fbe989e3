// A linked GLSL program.
#pragma once

#include <glad/gl.h>

namespace crowd {

class GpuProgram {
 public:
  // Throws std::runtime_error with the compiler's log.
  GpuProgram(const GladGLContext& gl, const char* vertex_source, const char* fragment_source);
  ~GpuProgram();
  GpuProgram(const GpuProgram&) = delete;
  GpuProgram& operator=(const GpuProgram&) = delete;

  void use() const { gl_.UseProgram(name_); }
  GLint uniform(const char* name) const { return gl_.GetUniformLocation(name_, name); }

 private:
  const GladGLContext& gl_;
  GLuint name_ = 0;
};

}  // namespace crowd
