#include "tests/gl/test_context.h"

#include <nook/nook_gl.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace nook::test {
namespace {

struct Driver {
  std::unique_ptr<platform::Context> context;
  std::vector<std::string> messages;
  std::string failure;
};

void GLAD_API_PTR keep_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text,
                               const void* user) {
  // Performance hints and notes are not faults.
  if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
      severity == GL_DEBUG_SEVERITY_HIGH)
    static_cast<std::vector<std::string>*>(const_cast<void*>(user))->push_back(text);
}

const char* variable(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value && *value ? value : otherwise;
}

void create(Driver& driver) {
  platform::ContextRequest request;
  request.kind = variable("NOOK_TEST_CONTEXT", "egl");
  request.width = request.height = 64;
  request.debug = true;
  const char* version = variable("NOOK_TEST_VERSION", "4.5");
  request.es = std::strncmp(version, "es", 2) == 0;
  if (request.es) version += 2;
  request.major = version[0] - '0';
  request.minor = version[2] - '0';
  try {
    driver.context = platform::create_context(request);
  } catch (const std::exception& e) {
    driver.failure = e.what();
    return;
  }
  std::printf("OpenGL %s on %s\n", driver.context->version().c_str(), driver.context->renderer().c_str());
  const GladGLContext& gl = driver.context->gl();
  if (gl.DebugMessageCallback) {
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(keep_message, &driver.messages);
  }
  const int wanted = 10 * request.major + request.minor;
  const bool exact = wanted == 33 || request.es;
  if (exact && version_of(*driver.context) != wanted)
    driver.failure = std::string("requested that version alone, ") + variable("NOOK_TEST_VERSION", "") +
                     ", and got " + driver.context->version();
}

Driver& driver() {
  // Left to the end of the process: the driver library may be unloaded before a destructor would run.
  static Driver* const made = [] {
    auto* d = new Driver;
    create(*d);
    return d;
  }();
  return *made;
}

}  // namespace

platform::Context* test_context() {
  Driver& d = driver();
  if (d.failure.empty()) return d.context.get();
  std::printf("NO OPENGL CONTEXT, TEST SKIPPED: %s\n", d.failure.c_str());
  if (std::strcmp(variable("NOOK_REQUIRE_GL", "0"), "1") == 0)
    FAIL("an OpenGL context is required: " << d.failure);
  return nullptr;
}

bool is_es(const GladGLContext& gl) {
  return std::strstr(reinterpret_cast<const char*>(gl.GetString(GL_VERSION)), "OpenGL ES") != nullptr;
}

int version_of(const platform::Context& context) {
  GLint major = 0, minor = 0;
  context.gl().GetIntegerv(GL_MAJOR_VERSION, &major);
  context.gl().GetIntegerv(GL_MINOR_VERSION, &minor);
  return 10 * major + minor;
}

std::vector<int> tiers_of(const platform::Context& context) {
  const int version = version_of(context);
  if (context.is_es())
    return version >= 31 ? std::vector<int>{NOOK_GL_TIER_ES31, NOOK_GL_TIER_ES30}
                         : std::vector<int>{NOOK_GL_TIER_ES30};
  return version >= 43 ? std::vector<int>{NOOK_GL_TIER_43, NOOK_GL_TIER_33}
                       : std::vector<int>{NOOK_GL_TIER_33};
}

bool computes(int tier) {
  return tier == NOOK_GL_TIER_43 || tier == NOOK_GL_TIER_ES31;
}

const char* glsl_header(const GladGLContext& gl) {
  return is_es(gl) ? "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                   : "#version 330 core\n";
}

std::vector<std::string> take_debug_messages() {
  return std::exchange(driver().messages, {});
}

}  // namespace nook::test
