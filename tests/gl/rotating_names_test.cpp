// Names that rotate, as in swap chains and in the frames of a headset: no frame makes a query about
// names that are known, and names of new textures are not taken for the old ones.
#include <functional>

#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 24, height = 16;

int queries(const Trace& trace) {
  return trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs") +
         trace.calls_that_begin("glCheckFramebuffer");
}

struct Chain {
  Chain(platform::Context& made_in, Trace& trace) : fixture(made_in) {
    gl = create_gl(fixture.host.handle, Trace::loader, &trace, 0, NOOK_GL_STATE_HOST);
    const Picture picture = look(camera, still_life(), width, height);
    for (int i = 0; i < 6; ++i) {
      ScreenFrame frame = frame_desc(camera, width, height, fixture.depth_of(camera, picture),
                                     fixture.normals_of(picture), 0.5f);
      frame.target = NOOK_TARGET_TEXTURE;
      frame.target_name = fixture.textures.floats(GL_RGBA8, 4, width, height, {});
      frames.push_back(frame);
    }
  }
  ~Chain() { nook_gl_destroy(&gl); }

  Camera camera = plain_camera(float(width) / height);
  NnaoFixture fixture;
  nook_gl gl = nullptr;
  std::vector<ScreenFrame> frames;
};

using Draw = std::function<void(const ScreenFrame&)>;

void check_rotations(Trace& trace, const Chain& chain, const Draw& draw) {
  for (const std::size_t names : {2u, 3u, 4u}) {
    INFO(names << " names");
    // A set is checked when it comes, and when it comes back.
    for (std::size_t i = 0; i < 2 * names; ++i) draw(chain.frames[i % names]);
    trace.reset();
    for (std::size_t i = 0; i < 6 * names; ++i) draw(chain.frames[i % names]);
    CHECK(queries(trace) == 0);
    // Images of a compositor come back in any order.
    for (const std::size_t i : {0u, 0u, 1u, 0u, 1u, 1u, 0u}) draw(chain.frames[i]);
    CHECK(queries(trace) == 0);
  }
  // More sets than are kept: each is checked again, as before.
  for (int i = 0; i < 24; ++i) draw(chain.frames[std::size_t(i % 6)]);
  trace.reset();
  for (int i = 0; i < 6; ++i) draw(chain.frames[std::size_t(i)]);
  CHECK(queries(trace) > 0);
}

}  // namespace

TEST_CASE("rotating names: a warm frame of the screen pass makes no query") {
  NOOK_NEED_CONTEXT(context);
  Trace trace(context);
  Chain chain(context, trace);
  for (const int half : {0, 1}) {
    PassDesc desc = pass_desc(width, height);
    desc.half_resolution = half;
    nook_nnao pass = create_pass(chain.gl, desc);
    check_rotations(trace, chain, [&](const ScreenFrame& frame) {
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    });
    nook_nnao_destroy(&pass);
  }
}

TEST_CASE("rotating names: a warm frame of the world pass makes no query") {
  NOOK_NEED_CONTEXT(context);
  Trace trace(context);
  Chain chain(context, trace);
  const world::View view;
  const std::vector<nook_capsule> casters = world::props(view);
  nook_world_desc desc = world::world_desc(width, height);
  nook_world pass = nullptr;
  NOOK_OK_OR_FAIL(nook_world_create(chain.gl, &desc, &pass));
  check_rotations(trace, chain, [&](const ScreenFrame& screen) {
    DarkenedFrame frame = world::world_frame(screen, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    frame.ao_texture = screen.normal_texture;  // any colours
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
  });
  nook_world_destroy(&pass);
}

TEST_CASE("rotating names: a name that was deleted and made anew is checked again") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  Trace trace(context);
  Chain chain(context, trace);
  nook_nnao pass = create_pass(chain.gl, pass_desc(width, height));
  const ScreenFrame &first = chain.frames[0], &second = chain.frames[1];
  const auto drawn = [&](const ScreenFrame& frame) { return nook_nnao_render(pass, &frame, &frame); };
  // Its name has the format from here on, as if it had been deleted and given again.
  const auto remake = [&](GLuint name, GLint internal_format, GLenum format, GLenum type) {
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, width, height, 0, format, type, nullptr);
    gl.BindTexture(GL_TEXTURE_2D, 0);
  };
  for (int i = 0; i < 3; ++i) NOOK_OK_OR_FAIL(drawn(first));
  NOOK_OK_OR_FAIL(drawn(second));
  remake(first.normal_texture, GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE);
  CHECK(drawn(first) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()).find("frame.normal_texture has a format") != std::string::npos);
  // After that, nothing is known.
  trace.reset();
  NOOK_OK_OR_FAIL(drawn(second));
  CHECK(queries(trace) > 0);
  // Another format that fits makes all others doubtful, too.
  remake(first.normal_texture, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  NOOK_OK_OR_FAIL(drawn(first));
  NOOK_OK_OR_FAIL(drawn(second));
  remake(first.normal_texture, GL_RGBA16F, GL_RGBA, GL_FLOAT);
  NOOK_OK_OR_FAIL(drawn(first));
  remake(second.normal_texture, GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE);
  CHECK(drawn(second) == NOOK_ERROR_INVALID_ARGUMENT);
  // While names rotate, textures_changed tells it.
  remake(second.normal_texture, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  for (int i = 0; i < 4; ++i)
    for (const ScreenFrame* frame : {&first, &second}) NOOK_OK_OR_FAIL(drawn(*frame));
  remake(second.normal_texture, GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE);
  ScreenFrame told = first;
  told.textures_changed = 1;
  NOOK_OK_OR_FAIL(drawn(told));
  CHECK(drawn(second) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_nnao_destroy(&pass);
}

TEST_CASE("depth of 16 bits is logged once by a pass") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const std::vector<std::uint16_t> values(std::size_t(width) * height, 60000);
  nook_nnao pass = create_pass(fixture.gl, pass_desc(width, height));
  nook_world_desc world_desc = world::world_desc(width, height);
  nook_world world = nullptr;
  NOOK_OK_OR_FAIL(nook_world_create(fixture.gl, &world_desc, &world));
  const auto warnings = [&] {
    return std::count_if(fixture.host.log.begin(), fixture.host.log.end(), [](const std::string& line) {
      return line.find("has 16 bits (GL_DEPTH_COMPONENT16 or half floats") != std::string::npos;
    });
  };
  const auto render = [&](GLuint depth) {
    const ScreenFrame frame = frame_desc(camera, width, height, depth, 0, 0.5f);
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  };
  const Picture picture = look(camera, still_life(), width, height);
  render(fixture.depth_of(camera, picture));
  render(fixture.textures.floats(GL_DEPTH_COMPONENT24, 1, width, height, stored_depth(camera, picture)));
  CHECK(warnings() == 0);
  GLuint coarse[2];
  for (GLuint& name : coarse)
    name = fixture.textures.make(GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, width, height,
                                 values.data());
  for (int i = 0; i < 6; ++i) render(coarse[i % 2]);
  CHECK(warnings() == 1);
  DarkenedFrame frame(frame_desc(camera, width, height, coarse[0], 0, 0.5f));
  for (int i = 0; i < 2; ++i) NOOK_OK_OR_FAIL(nook_world_render(world, &frame, &frame));
  CHECK(warnings() == 2);
  nook_nnao_destroy(&pass);
  nook_world_destroy(&world);
  // Linear depth in half floats.
  pass = create_pass(fixture.gl, pass_desc(width, height));
  for (const GLint format : {GL_R32F, GL_R16F}) {
    ScreenFrame linear = frame_desc(
        camera, width, height, fixture.textures.floats(format, 1, width, height, picture.depth), 0, 0.5f);
    linear.depth_kind = NOOK_DEPTH_LINEAR;
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &linear, &linear));
    CHECK(warnings() == (format == GL_R16F ? 3 : 2));
  }
  nook_nnao_destroy(&pass);
}
