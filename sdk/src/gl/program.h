// Programs from the embedded shaders.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

// The text of an embedded shader. Throws Failure(NOOK_ERROR_INTERNAL) where there is none of that path.
const char* embedded_text(const char* path);

// `path` names an embedded shader, `defines` is put before its text ("#define A 1\n"). Throw
// Failure(NOOK_ERROR_GL) with the shader's name and the compiler's words; the whole log goes to the host's
// log.
Object compute_program(Device& device, const char* path, const char* defines);
// One vertex shader whose output `varying` is captured.
Object feedback_program(Device& device, const char* path, const char* defines, const char* varying);
// A vertex and a fragment shader.
Object draw_program(Device& device, const char* vertex_path, const char* fragment_path, const char* defines);

GLint uniform_location(const Device& device, const Object& program, const char* name);

}  // namespace nook::gl
