// The OpenGL context of the tests: one for the process, its kind and version from the environment.
//   NOOK_TEST_CONTEXT  egl (default), osmesa or window
//   NOOK_TEST_VERSION  the highest version to ask for, 3.3 or 4.5 (default); es3.0, es3.1 or es3.2 with the
//   kind egl,
//                      and exactly that (Mesa: MESA_GLES_VERSION_OVERRIDE)
//   NOOK_REQUIRE_GL=1  a context that cannot be had is a failure
#pragma once

#include <glad/gl.h>

#include <string>
#include <vector>

#include "platform/platform.h"
#include "tests/catch.h"

namespace nook::test {

// NULL, said aloud, where there is none; fails the test case then if a context is required.
platform::Context* test_context();

// The functions are of an OpenGL ES context.
bool is_es(const GladGLContext& gl);
// 10 * major + minor.
int version_of(const platform::Context& context);
// The tiers that this context has, best first.
std::vector<int> tiers_of(const platform::Context& context);
// The tier has compute shaders.
bool computes(int tier);
// The lines that begin a shader of the tests in the language of the context: version and precisions.
const char* glsl_header(const GladGLContext& gl);

// Errors and warnings that the driver reported through KHR_debug since the last call, in a debug context.
std::vector<std::string> take_debug_messages();

}  // namespace nook::test

// Begins every test case that needs OpenGL.
#define NOOK_NEED_CONTEXT(context)                                         \
  platform::Context* const context##_or_none = nook::test::test_context(); \
  if (!context##_or_none) return;                                          \
  platform::Context& context = *context##_or_none
