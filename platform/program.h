// GLSL programs of the tool, the samples and the tests.
#pragma once

#include <glad/gl.h>

#include <initializer_list>

namespace platform {

// Makes a linked program. The texts of a stage follow each other, and the first one begins with the #version
// line. The caller deletes the program. Throws std::runtime_error with the log of the compiler or the linker.
GLuint link_program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                    std::initializer_list<const char*> fragment);

// A linked program that deletes itself.
class Program {
 public:
  // The texts are those of link_program. The context must outlive this object.
  Program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
          std::initializer_list<const char*> fragment);
  Program(Program&& other) noexcept;
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_.UseProgram(name_); }
  GLuint name() const { return name_; }
  GLint uniform(const char* name) const { return gl_.GetUniformLocation(name_, name); }

 private:
  const GladGLContext& gl_;
  GLuint name_ = 0;
};

}  // namespace platform
