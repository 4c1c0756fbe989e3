// GLSL programs of the tool, the samples and the tests.
#pragma once

#include <glad/gl.h>

#include <initializer_list>

namespace platform {

// A linked program; the texts of a stage follow each other, the first with its #version line. The caller
// deletes it. Throws std::runtime_error with the compiler's or the linker's log.
GLuint link_program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                    std::initializer_list<const char*> fragment);

}  // namespace platform
