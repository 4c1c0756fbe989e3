// Any order of destruction is defined, and nothing is left behind in OpenGL.
#include <cstring>
#include <string_view>

#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

// A driver may keep a deleted program until it needs its place: it counts as gone.
bool is_living_program(const GladGLContext& gl, GLuint name) {
  GLint is_deleted = 0;
  if (gl.IsProgram(name)) gl.GetProgramiv(name, GL_DELETE_STATUS, &is_deleted);
  return gl.IsProgram(name) && !is_deleted;
}

// Names are small numbers handed out from 1 on, on every driver that the tests run on.
// Names grow past 2,000 in a run of all tests.
int living_objects(const GladGLContext& gl) {
  int count = 0;
  for (GLuint name = 1; name < 10000; ++name) {
    count += gl.IsBuffer(name) + gl.IsTexture(name) + is_living_program(gl, name) + gl.IsShader(name) +
             gl.IsVertexArray(name) + gl.IsFramebuffer(name) + gl.IsRenderbuffer(name);
    if (gl.IsTransformFeedback) count += gl.IsTransformFeedback(name);
  }
  return count;
}

}  // namespace

TEST_CASE("destroying everything in any order leaves no OpenGL object and no memory") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    const int before = living_objects(context.gl());
    // Each digit is what goes next: 0 gl, 1 scene, 2 model, 3 context.
    for (const char* order : {"0123", "1023", "3210", "2310", "1320", "3102"}) {
      INFO("tier " << tier << ", order " << order);
      CountedContext host;
      nook_model model = load_model(host.handle, sample_model(5));
      auto crowd = std::make_unique<Crowd>(host.handle, std::vector{model}, std::vector<std::uint32_t>{5},
                                           CrowdOptions{});
      nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd->scene));
      CHECK(living_objects(context.gl()) > before);
      for (const char* step = order; *step; ++step) {
        if (*step == '0') nook_gl_destroy(&gl);
        if (*step == '1') crowd.reset();
        if (*step == '2') nook_model_destroy(&model);
        if (*step == '3') nook_context_destroy(&host.handle);
      }
      CHECK(living_objects(context.gl()) == before);
      CHECK(host.bytes == 0);
    }
  }
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("a destroyed scene's objects go with the next update, a released one's at once") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(6));
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    Crowd stays(host.handle, {model}, {5}, {});
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, stays.scene));
    const std::uint64_t one_scene = info_of(gl).buffer_bytes;
    {
      Crowd goes(host.handle, {model}, {5}, {});
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, goes.scene));
      CHECK(info_of(gl).buffer_bytes > one_scene);
      NOOK_OK_OR_FAIL(nook_gl_scene_release(gl, goes.scene));
      CHECK(info_of(gl).buffer_bytes == one_scene);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, goes.scene));
      CHECK(info_of(gl).buffer_bytes > one_scene);
    }
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, stays.scene));
    CHECK(info_of(gl).buffer_bytes == one_scene);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("after the OpenGL context is lost nothing calls OpenGL, and destroy works") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(7));
  Crowd crowd(host.handle, {model}, {5}, {});
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    // Without a current context any OpenGL call would crash or be caught by the next check.
    context.clear_current();
    CHECK(nook_gl_context_lost(gl) == NOOK_OK);
    CHECK(info_of(gl).buffer_bytes == 0);
    CHECK(nook_gl_scene_update(gl, crowd.scene) == NOOK_ERROR_GL);
    CHECK(nook_gl_scene_prepare(gl, crowd.scene) == NOOK_ERROR_GL);
    CHECK(nook_gl_scene_release(gl, crowd.scene) == NOOK_ERROR_GL);
    nook_gl_destroy(&gl);
    context.make_current();
    // The scene goes on with a new one, whose AO is the CPU's.
    gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(difference_to_cpu(gl, crowd, model, 2) < promised_difference);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("views are refused where there is none, and hold 1 before the first update") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(8));
  Crowd crowd(host.handle, {model}, {5}, {});
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  nook_gl_view view{};
  view.struct_size = sizeof view;
  CHECK(nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, &view) ==
        NOOK_ERROR_INVALID_HANDLE);
  CHECK(nook_gl_scene_view(gl, crowd.scene, 12345, NOOK_CHANNEL_AO, &view) == NOOK_ERROR_INVALID_HANDLE);
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
  NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, &view));
  CHECK(view.count == file_vertices(model));
  CHECK(view.stride == 4);
  CHECK(context.gl().IsBuffer(view.buffer));
  for (const float ao : gpu_ao(gl, crowd, model, 0)) CHECK(ao == 1.0f);
  float one = 0;
  CHECK(nook_gl_scene_read(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, &one, 1) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_BENT_NORMAL, &view) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string_view(nook_last_message()).find("channel is not available on the GPU") !=
        std::string_view::npos);
  view.struct_size = 8;
  CHECK(nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, &view) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}

TEST_CASE("a view stays as it is while other instances come and go") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(8));
  Crowd crowd(host.handle, {model}, {5}, {});
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  nook_gl_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_describe(gl, &info));
  const std::string version = info.version;
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  const auto view_of = [&](std::size_t i) {
    nook_gl_view view{};
    view.struct_size = sizeof view;
    NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[i], NOOK_CHANNEL_AO, &view));
    return view;
  };
  const nook_gl_view first = view_of(0);
  const auto check_first = [&] {
    const nook_gl_view now = view_of(0);
    CHECK(now.buffer == first.buffer);
    CHECK(now.offset == first.offset);
    // The buffer that the host bound once holds the values of the last update.
    const std::vector<unsigned char> bytes =
        read_buffer(context.gl(), first.buffer, first.offset, 4 * std::size_t(first.count));
    std::vector<float> bound(first.count);
    std::memcpy(bound.data(), bytes.data(), bytes.size());
    CHECK(bound == gpu_ao(gl, crowd, model, 0));
  };
  for (std::size_t i = crowd.ids.size(); i < 40; ++i) {
    crowd.add(i);
    if (i % 10 == 0) NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
    if (i % 10 == 5) NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  }
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  CHECK(view_of(39).buffer != first.buffer);
  check_first();
  while (crowd.ids.size() > 1) {
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, crowd.ids.back()));
    crowd.ids.pop_back();
  }
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  check_first();
  CHECK(info.version == version);
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}

TEST_CASE("an empty scene is updated, and again after its last instance left") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(9));
  for (const int tier : tiers_of(context)) {
    CrowdOptions options;
    options.instances = 0;
    Crowd crowd(host.handle, {model}, {5}, options);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const std::uint64_t empty = info_of(gl).buffer_bytes;
    const nook_instance_id id = crowd.add(0);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(info_of(gl).buffer_bytes > empty);
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, id));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(info_of(gl).ao_bytes == 0);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}
