// Programs from the embedded shaders.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

// Returns the text of an embedded shader. Throws Failure(NOOK_ERROR_INTERNAL) if no shader has that path.
const char* embedded_text(const char* path);

// What shaders need beyond OpenGL 3.3 and OpenGL ES 3.0.
struct ShaderNeeds {
  bool sample_textures = false;   // multisample textures, which OpenGL ES 3.0 lacks
  bool sample_arrays = false;     // arrays of them, which OpenGL ES 3.1 lacks
  bool medium_precision = false;  // on OpenGL ES, floats of the fragment shader get it unless they are
                                  // declared otherwise
  bool gathers = false;           // textureGather, which tiers with compute shaders have
};

// Compiles and links a compute shader. `path` names an embedded shader, and `defines` is put before its text
// ("#define A 1\n"). These functions throw Failure(NOOK_ERROR_GL) with the shader's name and the start of the
// compiler's log; the host's log gets the whole text.
Object compute_program(Device& device, const char* path, const char* defines, ShaderNeeds needs = {});
// Links a single vertex shader and captures its output `varying`.
Object feedback_program(Device& device, const char* path, const char* defines, const char* varying);
Object draw_program(Device& device, const char* vertex_path, const char* fragment_path, const char* defines,
                    ShaderNeeds needs = {});

GLint uniform_location(const Device& device, const Object& program, const char* name);

}  // namespace nook::gl
