// A linked GLSL program.
#pragma once

#include <glad/gl.h>

#include <initializer_list>

namespace crowd {

class GpuProgram {
 public:
  // The fragment shader's texts are put one behind another. Throws std::runtime_error with the compiler's
  // log.
  GpuProgram(const GladGLContext& gl, const char* vertex_source,
             std::initializer_list<const char*> fragment_sources);
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
