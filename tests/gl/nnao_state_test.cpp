// The promise of nook_gl_state_mode for the screen-space pass, and what a frame may not do.
#include <nook/experimental/nook_stages.h>
#include <functional>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 33, height = 21;

// All settings of the pass, over images that are made once.
struct Stage {
  Stage(platform::Context& made_in, nook_gl_state_mode mode) : fixture(made_in, mode) {
    const Picture picture = look(camera, still_life(), width, height);
    depth = fixture.depth_of(camera, picture);
    normal = fixture.normals_of(picture);
    colour =
        fixture.textures.floats(GL_RGBA16F, 4, width, height, std::vector<float>(width * height * 4, 1.0f));
    layer = fixture.textures.floats(GL_R8, 1, width, height, std::vector<float>(width * height, 1.0f));
    const GladGLContext& gl = fixture.context.gl();
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  }
  ~Stage() { fixture.context.gl().DeleteFramebuffers(1, &framebuffer); }

  ScreenFrame frame() const { return frame_desc(camera, width, height, depth, normal, 0.5f); }
  ScreenFrame multiplied(nook_target target, GLuint name) const {
    ScreenFrame f = frame();
    f.gbuffer_ao = NOOK_GBUFFER_AO_MIN;
    f.gbuffer_ao_texture = layer;
    f.target = target;
    f.target_name = name;
    f.blend = NOOK_BLEND_MULTIPLY;
    return f;
  }

  Camera camera = plain_camera(float(width) / height);
  NnaoFixture fixture;
  GLuint depth = 0, normal = 0, colour = 0, layer = 0, framebuffer = 0;
};

using Check = std::function<void(const char*, Poison&, const std::function<void()>&)>;

unsigned users_of(nook_nnao_path path) {
  return path == NOOK_NNAO_PATH_COMPUTE ? gl::screen | gl::screen_compute : gl::screen;
}

void walk_path(platform::Context& context, nook_gl_state_mode mode, nook_nnao_path path, const Check& check) {
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper})
    for (const int half : {0, 1}) {
      // The state is the same for both forms but for the filters' texture.
      if (mode != NOOK_GL_STATE_PRESERVE && half == int(form == nnao::NetworkForm::paper)) continue;
      // Both paths bind that alike.
      if (path == NOOK_NNAO_PATH_COMPUTE && form == nnao::NetworkForm::paper) continue;
      Stage stage(context, mode);
      const nnao::Network network = mild_network(form);
      PassDesc desc = pass_desc(width, height);
      desc.taps = 16;
      desc.half_resolution = half;
      desc.debug.timers = 1;
      desc.debug.path = path;
      nook_nnao calm = create_pass(stage.fixture.gl, desc, network);
      const ScreenFrame frame = stage.frame();
      NOOK_OK_OR_FAIL(nook_nnao_render(calm, &frame, &frame));
      const std::vector<float> wanted = own_ao(context.gl(), calm, width, height);
      nook_nnao_destroy(&calm);

      nook_nnao pass = nullptr;
      nook_nnao_timings timings{};
      timings.struct_size = sizeof timings;
      const auto render = [&](const ScreenFrame& of) { NOOK_OK_OR_FAIL(nook_nnao_render(pass, &of, &of)); };
      const std::pair<const char*, std::function<void()>> steps[] = {
          {"create", [&] { pass = create_pass(stage.fixture.gl, desc, network); }},
          {"framebuffer", [&] { render(stage.multiplied(NOOK_TARGET_FRAMEBUFFER, stage.framebuffer)); }},
          {"texture", [&] { render(stage.multiplied(NOOK_TARGET_TEXTURE, stage.colour)); }},
          {"first frame", [&] { render(frame); }},
          {"later frame", [&] { render(frame); }},
          {"refused frame",
           [&] {
             ScreenFrame bad = frame;
             // Found after the inputs were bound, on every context: some do not tell formats.
             bad.target = NOOK_TARGET_TEXTURE;
             bad.target_name = stage.depth;
             CHECK(nook_nnao_render(pass, &bad, &bad) == NOOK_ERROR_INVALID_ARGUMENT);
           }},
      };
      for (const auto& [name, call] : steps) {
        const bool uploads = std::string(name) == "create" && context.is_es();
        Poison poison(context, users_of(path) | (uploads ? gl::texel_uploads : 0u));
        INFO("form " << int(form) << ", half " << half << ", path " << path);
        check(name, poison, call);
        CHECK(context.gl().GetError() == GL_NO_ERROR);
      }
      CHECK((own_ao(context.gl(), pass, width, height) == wanted));
      {
        Poison poison(context, gl::screen_timers);
        check("timings", poison, [&] { NOOK_OK_OR_FAIL(nook_nnao_read_timings(pass, &timings)); });
      }
      {
        Poison poison(context, users_of(path));
        check("destroy", poison, [&] { nook_nnao_destroy(&pass); });
      }
      CHECK(context.gl().GetError() == GL_NO_ERROR);
    }
}

void walk(platform::Context& context, nook_gl_state_mode mode, const Check& check) {
  for (const nook_nnao_path path : paths_of(context)) walk_path(context, mode, path, check);
}

}  // namespace

TEST_CASE("nnao: PRESERVE puts all state back") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_PRESERVE,
       [&](const char* step, Poison& poison, const std::function<void()>& call) {
         INFO(step);
         const StateValues touched = poison.touched(), untouched = poison.untouched();
         call();
         CHECK(poison.touched() == touched);
         CHECK(poison.untouched() == untouched);
       });
}

TEST_CASE("nnao: DEFAULTS leaves the defaults, and the viewport of the frame") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_DEFAULTS,
       [&](const char* step, Poison& poison, const std::function<void()>& call) {
         INFO(step);
         poison.reset_touched();
         const StateValues untouched = poison.untouched();
         call();
         StateValues touched = poison.touched();
         if (std::string(step) == "later frame")
           CHECK(touched["viewport"] == std::vector<std::int64_t>{0, 0, width, height});
         touched.erase("viewport");
         CHECK(touched == poison.defaults());
         CHECK(poison.untouched() == untouched);
       });
}

TEST_CASE("nnao: HOST touches only what the list names, and works whatever it finds") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_HOST, [&](const char* step, Poison& poison, const std::function<void()>& call) {
    INFO(step);
    const StateValues untouched = poison.untouched();
    call();
    CHECK(poison.untouched() == untouched);
  });
}

TEST_CASE("nnao: no parameter of the host's textures and samplers changes") {
  NOOK_NEED_CONTEXT(context);
  Stage stage(context, NOOK_GL_STATE_PRESERVE);
  const GladGLContext& gl = context.gl();
  const auto parameters = [&] {
    std::vector<GLint> values;
    for (const GLuint texture : {stage.depth, stage.normal, stage.colour, stage.layer}) {
      gl.BindTexture(GL_TEXTURE_2D, texture);
      for (const GLenum name :
           {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T,
            GL_TEXTURE_BASE_LEVEL, GL_TEXTURE_MAX_LEVEL, GL_TEXTURE_COMPARE_MODE, GL_TEXTURE_SWIZZLE_R}) {
        values.push_back(0);
        gl.GetTexParameteriv(GL_TEXTURE_2D, name, &values.back());
      }
    }
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return values;
  };
  // A shadow map's compare mode does not disturb the pass, which reads through samplers of its own.
  nook_nnao pass = create_pass(stage.fixture.gl, pass_desc(width, height));
  ScreenFrame frame = stage.frame();
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const std::vector<float> wanted = own_ao(gl, pass, width, height);
  gl.BindTexture(GL_TEXTURE_2D, stage.depth);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  const std::vector<GLint> before = parameters();
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  CHECK(parameters() == before);
  CHECK((own_ao(gl, pass, width, height) == wanted));
  nook_nnao_destroy(&pass);
}

TEST_CASE("nnao: a target is discarded only where a frame writes all of it") {
  NOOK_NEED_CONTEXT(context);
  Stage stage(context, NOOK_GL_STATE_HOST);
  Trace trace(context);
  nook_gl gl = create_gl(stage.fixture.host.handle, Trace::loader, &trace, 0, NOOK_GL_STATE_HOST);
  PassDesc desc = pass_desc(width, height);
  desc.debug.path = NOOK_NNAO_PATH_FRAGMENT;
  nook_nnao pass = create_pass(gl, desc);
  const auto discards = [&](const ScreenFrame& frame) {
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    trace.reset();
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    // Depth, AO and the filter along x.
    return trace.calls("glInvalidateFramebuffer") - 3;
  };
  if (context.is_es() || version_of(context) >= 43) {
    ScreenFrame frame = stage.frame();
    CHECK(discards(frame) == 1);
    frame.target = NOOK_TARGET_TEXTURE;
    frame.target_name = stage.colour;
    CHECK(discards(frame) == 1);
    frame.viewport[2] = width - 1;
    frame.viewport[3] = height;
    CHECK(discards(frame) == 0);
    CHECK(discards(stage.multiplied(NOOK_TARGET_TEXTURE, stage.colour)) == 0);
    frame = stage.frame();
    frame.target = NOOK_TARGET_FRAMEBUFFER;
    frame.target_name = stage.framebuffer;
    CHECK(discards(frame) == 0);
  }
  nook_nnao_destroy(&pass);
  nook_gl_destroy(&gl);
}

TEST_CASE("nnao: a frame allocates nothing, reads nothing back and queries OpenGL only with PRESERVE") {
  NOOK_NEED_CONTEXT(context);
  const nook_nnao_path best = paths_of(context).back();
  const struct {
    nook_gl_state_mode mode;
    int half;
    nook_nnao_path path;
  } settings[] = {{NOOK_GL_STATE_PRESERVE, 0, best},
                  {NOOK_GL_STATE_PRESERVE, 1, NOOK_NNAO_PATH_FRAGMENT},
                  {NOOK_GL_STATE_HOST, 0, NOOK_NNAO_PATH_FRAGMENT},
                  {NOOK_GL_STATE_HOST, 1, best}};
  for (const auto& [mode, half, path] : settings) {
    Stage stage(context, mode);
    Trace trace(context);
    nook_gl gl = create_gl(stage.fixture.host.handle, Trace::loader, &trace, 0, mode);
    PassDesc desc = pass_desc(width, height);
    desc.half_resolution = half;
    desc.debug.timers = 1;
    desc.debug.path = path;
    nook_nnao pass = create_pass(gl, desc);
    const int dispatches = path == NOOK_NNAO_PATH_COMPUTE;
    ScreenFrame frame = stage.frame();
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    nook_nnao_timings timings{};
    timings.struct_size = sizeof timings;
    trace.reset();
    const long allocations = stage.fixture.host.allocations;
    for (int i = 0; i < 6; ++i) {
      frame.viewport[2] = width - i;
      frame.viewport[3] = height - i;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    }
    CHECK(stage.fixture.host.allocations == allocations);
    // Depth, AO, the filter along x, at half resolution along y, resolve.
    CHECK(trace.calls("glDrawArrays") == 6 * ((half ? 5 : 4) - dispatches));
    CHECK(trace.calls("glDispatchCompute") == 6 * dispatches);
    // Every draw into a texture of the pass, but of the results the first alone: the others have a viewport
    // that is a part of the target.
    const bool discards = context.is_es() || version_of(context) >= 43;
    CHECK(trace.calls("glInvalidateFramebuffer") == (discards ? 6 * ((half ? 4 : 3) - dispatches) + 1 : 0));
    // Before the dispatch and after it.
    CHECK(trace.calls("glMemoryBarrier") == 12 * dispatches);
    for (const char* forbidden : {"glGen", "glTexImage", "glBufferData", "glGetBufferSubData", "glGetError",
                                  "glGetTexLevel", "glGetFramebuffer", "glCheckFramebuffer", "glGetQuery"})
      CHECK(trace.calls_that_begin(forbidden) == 0);
    const int asked = trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs");
    if (mode == NOOK_GL_STATE_PRESERVE)
      CHECK(asked > 0);
    else
      CHECK(asked == 0);
    // Finished stages are found without waiting; whether one is finished by now is the driver's affair.
    NOOK_OK_OR_FAIL(nook_nnao_read_timings(pass, &timings));
    context.gl().Finish();
    NOOK_OK_OR_FAIL(nook_nnao_read_timings(pass, &timings));
    // A driver may learn of the end of work with the next submission alone, as Mesa's zink does.
    for (int i = 0; i < 10 && !timings.valid; ++i) {
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      context.gl().Finish();
      NOOK_OK_OR_FAIL(nook_nnao_read_timings(pass, &timings));
    }
    CHECK(timings.valid == 1);
    nook_nnao_destroy(&pass);
    nook_gl_destroy(&gl);
  }
}
