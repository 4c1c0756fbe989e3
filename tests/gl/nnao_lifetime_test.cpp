// Memory of a pass, any order of destruction, refused allocations, lost contexts.
#include <nook/experimental/nook_stages.h>
#include <cstring>

#include "sdk/src/nnao/network_file.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// Names are numbers handed out from 1 on, on every driver that the tests run on; a run of all tests passes
// 2,000.
int living_objects(const GladGLContext& gl) {
  int count = 0;
  for (GLuint name = 1; name < 10000; ++name)
    count += gl.IsBuffer(name) + gl.IsTexture(name) + gl.IsProgram(name) + gl.IsShader(name) +
             gl.IsSampler(name) + gl.IsQuery(name) + gl.IsVertexArray(name) + gl.IsFramebuffer(name) +
             gl.IsRenderbuffer(name);
  return count;
}

}  // namespace

TEST_CASE("nnao: memory is known before, and small enough at 3840 x 2160") {
  PassDesc desc = pass_desc(3840, 2160);
  std::uint64_t bytes = 0;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 9);
  CHECK(bytes <= 80'000'000);
  desc.blur = 2;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 9);
  desc.blur = 1;
  desc.half_resolution = 1;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 3);
  desc.blur = 0;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 5 / 2);
  // A mean over frames keeps 12 bytes more for each pixel.
  desc.blur = 1;
  desc.half_resolution = 0;
  desc.max_history_frames = 4;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * (9 + 12));
  desc.blur = 0;
  desc.max_history_frames = 0;
  // The paper's form keeps normals as well.
  const std::vector<std::byte> paper = nnao::write_network(mild_network(nnao::NetworkForm::paper));
  desc.network = paper.data();
  desc.network_size = paper.size();
  desc.half_resolution = 0;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 11);
  desc.network_size = 50;
  CHECK(nook_nnao_memory(&desc, &bytes) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("nnao: a pass takes the memory that was promised, and opens with AO 1") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  for (const int half : {0, 1}) {
    PassDesc desc = pass_desc(37, 23);
    desc.half_resolution = half;
    std::uint64_t bytes = 0;
    NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
    nook_nnao pass = create_pass(fixture.gl, desc);
    const nook_nnao_info info = info_of(pass);
    CHECK(info.texture_bytes == bytes);
    CHECK(info.taps == 9);
    CHECK(info.horizon_form == 1);
    for (const float value : own_ao(context.gl(), pass, 37, 23)) REQUIRE(value == 1);
    nook_nnao_timings timings{};
    timings.struct_size = sizeof timings;
    timings.valid = 5;
    NOOK_OK_OR_FAIL(nook_nnao_read_timings(pass, &timings));
    CHECK(timings.valid == 0);
    nook_nnao_destroy(&pass);
  }
}

TEST_CASE("nnao: a pass, its nook_gl and its context may go in any order") {
  NOOK_NEED_CONTEXT(context);
  const int before = living_objects(context.gl());
  for (const char* order : {"012", "021", "102", "120", "201", "210"}) {
    INFO(order);
    CountedContext host;
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
    PassDesc desc = pass_desc(32, 32);
    desc.debug.timers = 1;
    nook_nnao pass = create_pass(gl, desc, mild_network(nnao::NetworkForm::paper));
    CHECK(living_objects(context.gl()) > before);
    for (const char* step = order; *step; ++step) {
      if (*step == '0') nook_nnao_destroy(&pass);
      if (*step == '1') nook_gl_destroy(&gl);
      if (*step == '2') nook_context_destroy(&host.handle);
    }
    CHECK(living_objects(context.gl()) == before);
    CHECK(host.bytes == 0);
  }
}

TEST_CASE("nnao: a failed creation leaves nothing behind") {
  NOOK_NEED_CONTEXT(context);
  const int before = living_objects(context.gl());
  {
    CountedContext host;
    Trace trace(context);
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, 0);
    const int with_gl = living_objects(context.gl());
    const long long bytes = host.bytes;
    PassDesc desc = pass_desc(32, 32);
    nook_nnao pass = nullptr;
    int refusals = 0;
    for (long n = 0; pass == nullptr; ++n) {
      host.refuse_after = n;
      const nook_result result = nook_nnao_create(gl, &desc, &pass);
      host.refuse_after = -1;
      if (result == NOOK_OK) break;
      ++refusals;
      REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
      CHECK(living_objects(context.gl()) == with_gl);
      CHECK(host.bytes == bytes);
    }
    CHECK(refusals >= 2);
    nook_nnao_destroy(&pass);

    trace.shaders_fail = true;
    CHECK(nook_nnao_create(gl, &desc, &pass) == NOOK_ERROR_GL);
    CHECK(std::string(nook_last_message()).find("compiling nnao/screen.vert failed") != std::string::npos);
    trace.shaders_fail = false;
    trace.limits[GL_MAX_TEXTURE_SIZE] = 16;
    CHECK(nook_nnao_create(gl, &desc, &pass) == NOOK_ERROR_UNSUPPORTED);
    CHECK(std::string(nook_last_message()).find("got 32 x 32, need at most 16 x 16") != std::string::npos);
    CHECK(living_objects(context.gl()) == with_gl);
    CHECK(host.bytes == bytes);
    nook_gl_destroy(&gl);
  }
  CHECK(living_objects(context.gl()) == before);
}

TEST_CASE("nnao: after the OpenGL context is lost nothing calls OpenGL, and destroy works") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  PassDesc desc = pass_desc(16, 16);
  desc.debug.timers = 1;
  nook_nnao pass = create_pass(gl, desc);
  // Without a current context any OpenGL call would crash or be caught by the next check.
  context.clear_current();
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  const ScreenFrame frame = frame_desc(plain_camera(1), 16, 16, 1, 0, 0.5f);
  CHECK(nook_nnao_render(pass, &frame, &frame) == NOOK_ERROR_GL);
  nook_nnao_timings timings{};
  timings.struct_size = sizeof timings;
  CHECK(nook_nnao_read_timings(pass, &timings) == NOOK_ERROR_GL);
  nook_nnao other = nullptr;
  CHECK(nook_nnao_create(gl, &desc, &other) == NOOK_ERROR_GL);
  nook_nnao_destroy(&pass);
  nook_gl_destroy(&gl);
  context.make_current();
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("nnao: a preset gives taps, resolution and filter where they are -1") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const int width = 48, height = 32;
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const ScreenFrame frame =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 0.5f);
  const auto drawn = [&](nook_nnao_preset preset, int taps, int half, int blur) {
    PassDesc desc = pass_desc(width, height);
    desc.preset = preset;
    desc.taps = taps;
    desc.half_resolution = half;
    desc.blur = blur;
    nook_nnao pass = create_pass(fixture.gl, desc);
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    std::vector<float> ao = own_ao(context.gl(), pass, width, height);
    nook_nnao_destroy(&pass);
    return ao;
  };
  const int given = -1;
  const std::vector<float> fast = drawn(NOOK_NNAO_PRESET_FAST, given, given, given);
  const std::vector<float> plain = drawn(NOOK_NNAO_PRESET_DEFAULT, given, given, given);
  const std::vector<float> best = drawn(NOOK_NNAO_PRESET_BEST, given, given, given);
  CHECK(fast == drawn(NOOK_NNAO_PRESET_BEST, 9, 1, 1));
  CHECK(plain == drawn(NOOK_NNAO_PRESET_BEST, 9, given, given));
  CHECK(best == drawn(NOOK_NNAO_PRESET_FAST, 32, 0, given));
  CHECK(plain == drawn(NOOK_NNAO_PRESET_FAST, given, 0, 1));
  CHECK(plain != fast);
  CHECK(plain != best);
  CHECK(plain != drawn(NOOK_NNAO_PRESET_DEFAULT, given, given, 0));
}
