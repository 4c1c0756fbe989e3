// GLSL programs of the tool, the samples and the tests.
#pragma once

#include <glad/gl.h>

#include <initializer_list>

namespace platform {

// Compiles and links a program, which the caller must delete. The texts of a stage are concatenated. The
// first text must begin with the #version line. Throws std::runtime_error with the compiler's or linker's
// log.
GLuint link_program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                    std::initializer_list<const char*> fragment);

// A linked program that is deleted by the destructor.
class Program {
 public:
  // Takes the same texts as link_program. The context must outlive this object.
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
