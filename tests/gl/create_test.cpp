// Creation: what is missing is named; what is only optional is done without.
#include <cstdio>
#include <cstring>
#include <memory>

#include "sdk/src/gl/functions.h"
#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

nook_gl_desc desc_of(Trace& trace, int tier) {
  nook_gl_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
  desc.get_proc = Trace::loader;
  desc.get_proc_user = &trace;
  desc.max_tier = tier;
  return desc;
}

bool message_has(const std::string& part) {
  return std::strstr(nook_last_message(), part.c_str()) != nullptr;
}

// The functions of the lowest tier.
std::vector<std::string> required(const platform::Context& context) {
  std::vector<std::string> names = {
#define NOOK_X(name) "gl" #name,
      NOOK_GL_FUNCTIONS_COMMON(NOOK_X) NOOK_GL_FUNCTIONS_MAPS(NOOK_X)};
  const std::vector<std::string> desktop = {NOOK_GL_FUNCTIONS_33(NOOK_X)},
                                 es = {NOOK_GL_FUNCTIONS_ES30(NOOK_X)};
#undef NOOK_X
  const std::vector<std::string>& more = context.is_es() ? es : desktop;
  names.insert(names.end(), more.begin(), more.end());
  return names;
}
std::vector<std::string> required_for_compute() {
  return {
#define NOOK_X(name) "gl" #name,
      NOOK_GL_FUNCTIONS_COMPUTE(NOOK_X)
#undef NOOK_X
  };
}
std::vector<std::string> optional() {
  return {
#define NOOK_X(name) "gl" #name,
      NOOK_GL_FUNCTIONS_OPTIONAL(NOOK_X)
#undef NOOK_X
  };
}

}  // namespace

TEST_CASE("the best tier is chosen unless max_tier is lower") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const int best = tiers_of(context).front(), least = tiers_of(context).back();
  // A tier of the other kind counts as its like.
  for (const int wanted :
       {NOOK_GL_TIER_BEST, NOOK_GL_TIER_33, NOOK_GL_TIER_43, NOOK_GL_TIER_ES30, NOOK_GL_TIER_ES31}) {
    INFO("max_tier " << wanted);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, wanted);
    const nook_gl_info info = info_of(gl);
    CHECK(info.tier == (wanted == NOOK_GL_TIER_33 || wanted == NOOK_GL_TIER_ES30 ? least : best));
    CHECK(info.version == context.version());
    CHECK(info.renderer == context.renderer());
    nook_gl_destroy(&gl);
    CHECK(gl == nullptr);
  }
}

TEST_CASE("each required function that the loader lacks is named") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  for (const int tier : tiers_of(context)) {
    std::vector<std::string> names = required(context);
    if (computes(tier))
      for (const std::string& name : required_for_compute()) names.push_back(name);
    for (const std::string& name : names) {
      Trace trace(context);
      trace.hidden.insert(name);
      const nook_gl_desc desc = desc_of(trace, tier);
      nook_gl gl = reinterpret_cast<nook_gl>(&trace);
      INFO(name);
      CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_UNSUPPORTED);
      CHECK(gl == nullptr);
      CHECK(message_has("nook_gl_create: get_proc did not return the required function \"" + name + "\""));
    }
  }
}

TEST_CASE("a context that is too old is refused with its version") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const struct {
    const char* version;
    int major, minor;
    const char* message;
  } contexts[] = {
      {"3.2 (Core Profile) Mesa", 3, 2, "the current context has OpenGL 3.2, need 3.3 core or newer"},
      {"2.1 Mesa", 0, 0, "the current context has OpenGL 0.0, need 3.3 core or newer; is a context current"},
      {"OpenGL ES 2.0 Mesa", 0, 0, "the current context has OpenGL ES 2.0, need OpenGL ES 3.0 or newer"},
  };
  for (const auto& old : contexts) {
    Trace trace(context);
    trace.version = old.version;
    trace.limits[GL_MAJOR_VERSION] = old.major;
    trace.limits[GL_MINOR_VERSION] = old.minor;
    const nook_gl_desc desc = desc_of(trace, 0);
    nook_gl gl = nullptr;
    CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_UNSUPPORTED);
    INFO(nook_last_message());
    CHECK(message_has(old.message));
  }
}

TEST_CASE("an OpenGL ES 2.0 context is refused by its name and left without an error") {
  NOOK_NEED_CONTEXT(context);
  platform::ContextRequest request;
  request.es = true;
  request.major = 2;
  request.minor = 0;
  std::unique_ptr<platform::Context> old;
  try {
    old = platform::create_context(request);
  } catch (const std::exception& e) {
    std::printf("no OpenGL ES 2.0 here: %s\n", e.what());
  }
  if (old && old->version().find("OpenGL ES 2.") == std::string::npos) {
    // Drivers give the highest version that is compatible; MESA_GLES_VERSION_OVERRIDE=2.0 gives 2.0 itself.
    std::printf("requested OpenGL ES 2.0, got %s\n", old->version().c_str());
  } else if (old) {
    CountedContext host;
    Trace trace(*old);
    const nook_gl_desc desc = desc_of(trace, 0);
    nook_gl gl = nullptr;
    CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_UNSUPPORTED);
    CHECK(message_has("the current context has OpenGL ES 2.0, need OpenGL ES 3.0 or newer"));
    CHECK(old->gl().GetError() == GL_NO_ERROR);
  }
  old.reset();
  context.make_current();
}

TEST_CASE("a shader that does not compile is named, and nothing is left behind") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    CountedContext host;
    Trace trace(context);
    trace.shaders_fail = true;
    const nook_gl_desc desc = desc_of(trace, tier);
    const long long bytes = host.bytes;
    nook_gl gl = nullptr;
    CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_GL);
    CHECK(message_has(computes(tier) ? "compiling character/spheres.comp failed"
                                     : "compiling character/vertices.vert failed"));
    CHECK(host.bytes == bytes);
    CHECK(trace.calls("glCreateShader") == trace.calls("glDeleteShader"));
    CHECK(trace.calls("glCreateProgram") == trace.calls("glDeleteProgram"));
  }
}

TEST_CASE("the lower tier needs nothing of the higher one") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  Trace trace(context);
  nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tiers_of(context).back());
  for (const std::string& name : required_for_compute()) CHECK(trace.asked.count(name) == 0);
  nook_gl_destroy(&gl);
}

TEST_CASE("without the optional functions everything still agrees") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(3));
  for (const int tier : tiers_of(context)) {
    Trace trace(context);
    for (const std::string& name : optional()) trace.hidden.insert(name);
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier);
    Crowd crowd(host.handle, {model}, {5}, {});
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(difference_to_cpu(gl, crowd, model, 1) < promised_difference);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("bad descriptors are refused with their field") {
  CountedContext host;
  nook_gl_desc good;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&good));
  CHECK(good.state_mode == NOOK_GL_STATE_PRESERVE);
  CHECK(good.max_tier == 0);
  good.get_proc = [](void*, const char*) -> void* { return nullptr; };
  nook_gl gl = nullptr;

  nook_gl_desc desc = good;
  desc.get_proc = nullptr;
  CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.get_proc is NULL"));
  desc = good;
  desc.max_tier = 40;
  CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.max_tier is unknown (got 40"));
  desc = good;
  desc.state_mode = 3;
  CHECK(nook_gl_create(host.handle, &desc, &gl) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.state_mode is unknown (got 3"));
  CHECK(nook_gl_create(nullptr, &good, &gl) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_create(host.handle, nullptr, &gl) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_create(host.handle, &good, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_create(host.handle, &good, &gl) == NOOK_ERROR_UNSUPPORTED);
  CHECK(nook_gl_desc_init(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_desc_init(NOOK_DESC_GL, &desc, 8, NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
}
