// Compiles and links programs from the embedded shaders.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

// Returns the text of an embedded shader. Throws Failure(NOOK_ERROR_INTERNAL) if there is no shader with this
// path.
const char* embedded_text(const char* path);

// Features that a shader needs beyond OpenGL 3.3 and OpenGL ES 3.0.
struct ShaderNeeds {
  bool sample_textures = false;   // multisample textures; not in OpenGL ES 3.0
  bool sample_arrays = false;     // arrays of multisample textures; not in OpenGL ES 3.1
  bool medium_precision = false;  // on OpenGL ES, the fragment shader's floats have medium precision unless
                                  // they are declared otherwise
  bool gathers = false;           // textureGather; in tiers with compute shaders
};

// Compiles and links a compute shader. `path` is the path of an embedded shader. `defines` is inserted before
// its text, for example "#define A 1\n". If compiling or linking fails, the functions in this file throw
// Failure(NOOK_ERROR_GL). The message contains the shader's name and the start of the compiler's log. The
// complete log is written to the host's log.
Object compute_program(Device& device, const char* path, const char* defines, ShaderNeeds needs = {});
// Links a program for transform feedback: a vertex shader whose output `varying` is captured.
Object feedback_program(Device& device, const char* path, const char* defines, const char* varying);
Object draw_program(Device& device, const char* vertex_path, const char* fragment_path, const char* defines,
                    ShaderNeeds needs = {});

GLint uniform_location(const Device& device, const Object& program, const char* name);

}  // namespace nook::gl
