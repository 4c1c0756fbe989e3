// GLSL programs of the tool, the samples and the tests.
#pragma once

#include <glad/gl.h>

#include <initializer_list>

namespace platform {

// Returns a linked program, which the caller deletes. The texts of a stage are concatenated; the first has
// the #version line. Throws std::runtime_error with the log of the compiler or the linker.
GLuint link_program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                    std::initializer_list<const char*> fragment);

}  // namespace platform
