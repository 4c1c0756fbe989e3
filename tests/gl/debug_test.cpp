// nook_gl_desc.debug: calls without the OpenGL context of nook_gl_create are refused by name, and frames
// without a surface are logged.
#include <EGL/egl.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 24, height = 16;

struct DebugGl {
  DebugGl(platform::Context& made_in, nook_context host, nook_gl_proc_fn loader, void* user,
          std::int32_t debug) {
    (void)made_in;
    nook_gl_desc desc;
    NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
    CHECK(desc.debug == 0);
    desc.get_proc = loader;
    desc.get_proc_user = user;
    desc.debug = debug;
    NOOK_OK_OR_FAIL(nook_gl_create(host, &desc, &handle));
  }
  ~DebugGl() { nook_gl_destroy(&handle); }
  DebugGl(const DebugGl&) = delete;
  DebugGl& operator=(const DebugGl&) = delete;

  nook_gl handle = nullptr;
};

std::ptrdiff_t lines_with(const CountedContext& host, const char* part) {
  return std::count_if(host.log.begin(), host.log.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

// Calls of the context thread; every other thread must be refused.
struct Calls {
  explicit Calls(platform::Context& context)
      : fixture(context), gl(context, cast.context.handle, platform::Context::loader, &context, 1) {
    crowd.emplace(cast.context.handle, cast.models, cast.bone_counts, CrowdOptions{});
    crowd->pose(0);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl.handle, crowd->scene));
    pass = create_pass(gl.handle, pass_desc(width, height));
    const nook_world_desc world_desc = world::world_desc(width, height);
    NOOK_OK_OR_FAIL(nook_world_create(gl.handle, &world_desc, &world));
    const Camera camera = plain_camera(float(width) / height);
    frame = frame_desc(camera, width, height,
                       fixture.depth_of(camera, look(camera, still_life(), width, height)), 0, 0.5f);
  }
  ~Calls() {
    nook_nnao_destroy(&pass);
    nook_world_destroy(&world);
  }

  std::vector<std::pair<const char*, nook_result>> all() {
    DarkenedFrame darkened(frame);
    nook_gl_view view{};
    view.struct_size = sizeof view;
    nook_nnao_info info{};
    info.struct_size = sizeof info;
    nook_nnao other = nullptr;
    const PassDesc desc = pass_desc(width, height);
    const nook_instance_id id = crowd->ids[0];
    std::vector<float> values(file_vertices(cast.model_of(0)));
    std::vector<std::pair<const char*, nook_result>> results;
    const auto call = [&](const char* name, nook_result result) { results.emplace_back(name, result); };
    call("nook_gl_scene_prepare", nook_gl_scene_prepare(gl.handle, crowd->scene));
    call("nook_gl_scene_update", nook_gl_scene_update(gl.handle, crowd->scene));
    call("nook_gl_scene_view", nook_gl_scene_view(gl.handle, crowd->scene, id, NOOK_CHANNEL_AO, &view));
    call("nook_gl_scene_read", nook_gl_scene_read(gl.handle, crowd->scene, id, NOOK_CHANNEL_AO, values.data(),
                                                  std::uint32_t(values.size())));
    call("nook_nnao_create", nook_nnao_create(gl.handle, &desc, &other));
    if (other) nook_nnao_destroy(&other);
    call("nook_nnao_render", nook_nnao_render(pass, &frame, &frame));
    call("nook_nnao_describe", nook_nnao_describe(pass, &info));
    call("nook_world_render", nook_world_render(world, &darkened, &darkened));
    return results;
  }
  void check_all_taken() {
    for (const auto& [name, result] : all()) {
      INFO(name << ": " << nook_last_message());
      CHECK(result == NOOK_OK);
    }
  }
  void check_all_refused(const char* text) {
    for (const auto& [name, result] : all()) {
      INFO(name);
      CHECK(result == NOOK_ERROR_GL);
    }
    CHECK(std::string(nook_last_message()).find(text) != std::string::npos);
  }

  NnaoFixture fixture;
  Cast cast;
  DebugGl gl;
  std::optional<Crowd> crowd;
  nook_nnao pass = nullptr;
  nook_world world = nullptr;
  ScreenFrame frame;
};

constexpr const char* none = "no OpenGL context is current on this thread";
constexpr const char* other = "another OpenGL context is current on this thread";

}  // namespace

TEST_CASE("debug: calls without the context of nook_gl_create are refused by name") {
  NOOK_NEED_CONTEXT(context);
  Calls calls(context);
  calls.check_all_taken();
  SECTION("on a thread that has none") {
    std::thread([&] { calls.check_all_refused(none); }).join();
  }
  SECTION("after the host has cleared it") {
    context.clear_current();
    calls.check_all_refused(none);
  }
  SECTION("in another context") {
    platform::ContextRequest request;
    request.major = 3;
    request.minor = context.is_es() ? 0 : 3;
    request.es = context.is_es();
    std::unique_ptr<platform::Context> second;
    try {
      second = platform::create_context(request);
    } catch (const std::exception& fault) {
      // Beside a window's context, EGL may be unable to make one of its own current.
      std::printf("no second OpenGL context here: %s\n", fault.what());
      context.make_current();
      return;
    }
    calls.check_all_refused(other);
    // Also with objects of these names, and with a nook_gl of its own.
    GLuint arrays[64];
    second->gl().GenVertexArrays(64, arrays);
    for (const GLuint array : arrays) second->gl().BindVertexArray(array);
    CountedContext host;
    const DebugGl of_second(*second, host.handle, platform::Context::loader, second.get(), 1);
    calls.check_all_refused(other);
  }
  context.make_current();
  calls.check_all_taken();
  for (const std::string& line : calls.cast.context.log)
    CHECK(line.find("cannot delete") == std::string::npos);
}

TEST_CASE("debug: a context that shares objects is another one") {
  NOOK_NEED_CONTEXT(context);
  const EGLContext own = eglGetCurrentContext();
  if (own == EGL_NO_CONTEXT) return;  // of another kind
  Calls calls(context);
  const EGLDisplay display = eglGetCurrentDisplay();
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION,
                               context.is_es() ? 0 : 3, EGL_NONE};
  EGLint config_id = 0;
  eglQueryContext(display, own, EGL_CONFIG_ID, &config_id);
  EGLConfig config = nullptr;
  EGLint found = 0;
  const EGLint wanted[] = {EGL_CONFIG_ID, config_id, EGL_NONE};
  if (config_id != 0) eglChooseConfig(display, wanted, &config, 1, &found);
  const EGLContext shared = eglCreateContext(display, config, own, attributes);
  REQUIRE(shared != EGL_NO_CONTEXT);
  REQUIRE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, shared));
  calls.check_all_refused(other);
  // Its objects are left, and the log has a line about them.
  nook_nnao_destroy(&calls.pass);
  CHECK(lines_with(calls.cast.context, "cannot delete") == 1);
  context.make_current();
  eglDestroyContext(display, shared);
  nook_result update = nook_gl_scene_update(calls.gl.handle, calls.crowd->scene);
  CHECK(update == NOOK_OK);
}

TEST_CASE("debug: a frame without a surface is logged by a later frame, once") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const GLuint seen = fixture.depth_of(camera, look(camera, still_life(), width, height));
  const GLuint cleared =
      fixture.textures.floats(GL_R32F, 1, width, height, std::vector<float>(width * height, 1.0f));
  const GLuint metres =
      fixture.textures.floats(GL_R32F, 1, width, height, std::vector<float>(width * height, 2.5f));
  for (const std::int32_t debug : {0, 1}) {
    CountedContext host;
    Trace trace(context);
    const DebugGl gl(context, host.handle, Trace::loader, &trace, debug);
    nook_nnao pass = create_pass(gl.handle, pass_desc(width, height));
    nook_world_desc world_desc = world::world_desc(width, height);
    nook_world world = nullptr;
    NOOK_OK_OR_FAIL(nook_world_create(gl.handle, &world_desc, &world));
    const auto reports = [&] { return lines_with(host, "an earlier frame showed no surface"); };
    const auto render = [&](GLuint depth, int frames) {
      for (int i = 0; i < frames; ++i) {
        ScreenFrame frame = frame_desc(camera, width, height, depth, 0, 0.5f);
        DarkenedFrame darkened(frame);
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        NOOK_OK_OR_FAIL(nook_world_render(world, &darkened, &darkened));
        context.gl().Finish();  // so that answers are there
      }
    };
    render(seen, 4);
    CHECK(reports() == 0);
    render(cleared, 6);
    CHECK(reports() == 2 * debug);  // of each pass
    render(seen, 4);
    render(cleared, 4);
    CHECK(reports() == 4 * debug);
    // Linear depth in metres, given as hardware depth.
    render(seen, 4);
    render(metres, 4);
    CHECK(reports() == 6 * debug);
    CHECK((trace.calls("glBeginQuery") > 0) == (debug == 1));
    for (const char* forbidden : {"glReadPixels", "glGetBufferSubData", "glMapBufferRange", "glFinish"})
      CHECK(trace.calls(forbidden) == 0);
    nook_nnao_destroy(&pass);
    nook_world_destroy(&world);
  }
}

TEST_CASE("debug: a mask that covers every surface is logged, by each pass") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const GLuint depth = fixture.depth_of(camera, look(camera, still_life(), width, height));
  // AO 1 and a weight.
  const auto mask = [&](float weight, float of_first_half) {
    std::vector<float> pixels;
    for (int i = 0; i < width * height; ++i) {
      const float w = i < width * height / 2 ? of_first_half : weight;
      pixels.insert(pixels.end(), {1, w});
    }
    return fixture.textures.floats(GL_RG32F, 2, width, height, pixels);
  };
  const GLuint all = mask(1, 1), half = mask(1, 0), most = mask(0.7f, 0.7f);
  CountedContext host;
  Trace trace(context);
  const DebugGl gl(context, host.handle, Trace::loader, &trace, 1);
  // Of new passes, which see one mask after the other.
  const auto reports = [&](const std::vector<GLuint>& textures, nook_gbuffer_ao mode) {
    nook_nnao pass = create_pass(gl.handle, pass_desc(width, height));
    nook_world_desc world_desc = world::world_desc(width, height);
    nook_world world = nullptr;
    NOOK_OK_OR_FAIL(nook_world_create(gl.handle, &world_desc, &world));
    const std::ptrdiff_t before = lines_with(host, "the mask covers every surface");
    for (std::size_t i = 0; i < 4 * textures.size(); ++i) {
      ScreenFrame frame = frame_desc(camera, width, height, depth, 0, 0.5f);
      frame.gbuffer_ao = mode;
      frame.gbuffer_ao_texture = textures[i / 4];
      DarkenedFrame darkened(frame);
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      NOOK_OK_OR_FAIL(nook_world_render(world, &darkened, &darkened));
      context.gl().Finish();  // so that answers are there
    }
    nook_nnao_destroy(&pass);
    nook_world_destroy(&world);
    return lines_with(host, "the mask covers every surface") - before;
  };
  CHECK(reports({half}, NOOK_GBUFFER_AO_EXCLUDE) == 0);
  CHECK(reports({all}, NOOK_GBUFFER_AO_EXCLUDE) == 2);
  CHECK(reports({half}, NOOK_GBUFFER_AO_REPLACE) == 0);
  CHECK(reports({all}, NOOK_GBUFFER_AO_REPLACE) == 2);
  // A weight above one half excludes a surface from the screen pass, but it is mixed otherwise.
  CHECK(reports({most}, NOOK_GBUFFER_AO_REPLACE) == 0);
  CHECK(reports({most}, NOOK_GBUFFER_AO_EXCLUDE) == 1);
  // A mask that was right: the camera came close to a character.
  CHECK(reports({half, all, half, all}, NOOK_GBUFFER_AO_EXCLUDE) == 0);
  CHECK(reports({all, half, all}, NOOK_GBUFFER_AO_EXCLUDE) == 2);
  // The smaller AO counts, so green has no meaning.
  CHECK(reports({all}, NOOK_GBUFFER_AO_MIN) == 0);
}

TEST_CASE("debug: a radius in another unit than the depth is logged, once") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  // So many rows that half a metre covers 5 to 25 of them, as the surfaces are 1 to 6 metres away.
  constexpr int wide = 96, high = 64;
  const Camera camera = plain_camera(float(wide) / high);
  Picture picture = look(camera, still_life(), wide, high);
  const GLuint depth = fixture.depth_of(camera, picture);
  for (float& surface : picture.depth) surface *= 0.15f;
  const GLuint close = fixture.depth_of(camera, picture);
  for (const std::int32_t half : {0, 1}) {
    CountedContext host;
    Trace trace(context);
    const DebugGl gl(context, host.handle, Trace::loader, &trace, 1);
    PassDesc desc = pass_desc(wide, high);
    desc.half_resolution = half;
    nook_nnao pass = create_pass(gl.handle, desc);
    const auto render = [&](float radius, nook_nnao_radius_kind kind, GLuint seen) {
      for (int i = 0; i < 6; ++i) {
        ScreenFrame frame = frame_desc(camera, wide, high, seen, 0, radius);
        frame.radius_kind = kind;
        frame.scene_size = 100;
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        context.gl().Finish();  // so that answers are there
      }
      return std::pair(lines_with(host, "the radius is larger than the picture"),
                       lines_with(host, "the radius is smaller than two pixels"));
    };
    using Counts = std::pair<std::ptrdiff_t, std::ptrdiff_t>;
    // Metres; a share of the screen fits every depth.
    CHECK((render(0.5f, NOOK_NNAO_RADIUS_METRES, depth) == Counts{0, 0}));
    CHECK((render(1, NOOK_NNAO_RADIUS_SCREEN, depth) == Counts{0, 0}));
    // Centimetres in a scene in metres, and metres in kilometres or a scene in centimetres.
    CHECK((render(50, NOOK_NNAO_RADIUS_METRES, depth) == Counts{1, 0}));
    CHECK((render(0.005f, NOOK_NNAO_RADIUS_METRES, depth) == Counts{1, 1}));
    CHECK((render(0.5f, NOOK_NNAO_RADIUS_SCENE, depth) == Counts{2, 1}));
    // Two metres fit the picture, until the camera is in front of a wall.
    CHECK((render(2, NOOK_NNAO_RADIUS_METRES, depth) == Counts{2, 1}));
    CHECK((render(2, NOOK_NNAO_RADIUS_METRES, close) == Counts{2, 1}));
    CHECK((render(2.1f, NOOK_NNAO_RADIUS_METRES, close) == Counts{2, 1}));
    CHECK((render(2, NOOK_NNAO_RADIUS_METRES, depth) == Counts{2, 1}));
    CHECK((render(2.1f, NOOK_NNAO_RADIUS_METRES, close) == Counts{3, 1}));
    nook_nnao_destroy(&pass);
  }
}

TEST_CASE("debug: depth that is reversed without its projection is logged as reversed, not as a radius") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  constexpr int wide = 96, high = 64;
  CountedContext host;
  Trace trace(context);
  const DebugGl gl(context, host.handle, Trace::loader, &trace, 1);
  const auto reports = [&](const Camera& camera, bool turned) {
    std::vector<float> stored = stored_depth(camera, look(camera, still_life(), wide, high));
    for (float& depth : stored) depth = turned ? 1 - depth : depth;
    nook_nnao pass = create_pass(gl.handle, pass_desc(wide, high));
    host.log.clear();
    for (int i = 0; i < 6; ++i) {
      const ScreenFrame frame =
          frame_desc(camera, wide, high, fixture.textures.floats(GL_R32F, 1, wide, high, stored), 0, 0.5f);
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      context.gl().Finish();  // so that answers are there
    }
    nook_nnao_destroy(&pass);
    return std::pair(lines_with(host, "looks reversed"), std::ptrdiff_t(host.log.size()));
  };
  using Counts = std::pair<std::ptrdiff_t, std::ptrdiff_t>;
  for (const Camera& camera : cameras(float(wide) / high)) {
    INFO(camera.name);
    CHECK((reports(camera, false) == Counts{0, 0}));
  }
  // As glDepthRange(1, 0) writes it.
  // OpenGL ES cannot count the pixels that would fit, so there the message is about the radius.
  CHECK((reports(plain_camera(float(wide) / high), true) == Counts{context.is_es() ? 0 : 1, 1}));
}

TEST_CASE("debug: AO is the same with it, also of two eyes and of samples") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const std::vector<float> stored = stored_depth(camera, picture);
  const GLuint depth = fixture.depth_of(camera, picture),
               eyes = fixture.textures.array(GL_R32F, 1, width, height, {stored, stored});
  for (const int views : {0, 2}) {
    std::vector<float> found[2];
    for (const std::int32_t debug : {0, 1}) {
      const DebugGl gl(context, fixture.host.handle, platform::Context::loader, &context, debug);
      PassDesc desc = pass_desc(width, height);
      desc.views = views;
      nook_nnao pass = create_pass(gl.handle, desc);
      const ScreenFrame frame = frame_desc(camera, width, height, views ? eyes : depth, 0, 0.5f);
      for (int i = 0; i < 3; ++i) NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      for (int layer = 0; layer < std::max(views, 1); ++layer) {
        const std::vector<float> ao =
            read_texture(context.gl(), info_of(pass).texture, width, height, 1, views ? layer : -1);
        found[debug].insert(found[debug].end(), ao.begin(), ao.end());
      }
      nook_nnao_destroy(&pass);
    }
    CHECK((found[0] == found[1]));
    CHECK(*std::min_element(found[1].begin(), found[1].end()) < 0.9f);
  }
  nook_gl_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  desc.debug = 2;
  nook_gl bad = nullptr;
  CHECK(nook_gl_create(fixture.host.handle, &desc, &bad) == NOOK_ERROR_INVALID_ARGUMENT);
}
