// Texture arrays: two eyes in one call are the same as two frames.
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_stages.h>
#include <cstring>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 60, height = 40, eyes = 2;

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

// Two eyes with frusta of their own, and a scene that lies apart in their view spaces.
struct Eyes {
  Eyes() {
    for (int eye = 0; eye < eyes; ++eye) {
      Camera camera = plain_camera(float(width) / height);
      camera.projection[8] = eye ? 0.12f : -0.08f;
      std::vector<Surface> scene = still_life();
      for (Surface& surface : scene)
        if (surface.ball) surface.normal_or_centre += Vec3{eye ? 0.05f : -0.05f, 0, 0};
      cameras.push_back(camera);
      pictures.push_back(look(camera, scene, width, height));
      depths.push_back(stored_depth(camera, pictures.back()));
      normals.push_back(flat(pictures.back().normal));
      projections.insert(projections.end(), camera.projection, camera.projection + 16);
    }
  }

  std::vector<Camera> cameras;
  std::vector<Picture> pictures;
  std::vector<std::vector<float>> depths, normals;
  std::vector<float> projections;
};

struct Settings {
  int half = 0, blur = 1, temporal = 0, bent = 0;
};

PassDesc desc_of(const Settings& settings, int layers) {
  PassDesc desc = pass_desc(width, height);
  desc.half_resolution = settings.half;
  desc.blur = settings.blur;
  desc.max_history_frames = settings.temporal;
  desc.bent_normals = settings.bent;
  desc.views = layers;
  return desc;
}

std::vector<float> layer_of(const GladGLContext& gl, GLuint texture, int layer, int channels) {
  return read_texture(gl, texture, width, height, channels, layer);
}

}  // namespace

TEST_CASE("nnao: two eyes in one call have the AO of two calls") {
  NOOK_NEED_CONTEXT(context);
  const Eyes both;
  for (const Settings& settings : {Settings{}, Settings{1, 1}, Settings{0, 2}, Settings{0, 1, 8},
                                   Settings{1, 0, 4}, Settings{0, 1, 0, 1}}) {
    NnaoFixture fixture(context);
    const int channels = settings.bent ? 4 : 1;
    const GLuint depth = fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, both.depths);
    const GLuint normals = fixture.textures.array(GL_RGB32F, 3, width, height, both.normals);
    nook_nnao pass = create_pass(fixture.gl, desc_of(settings, eyes));
    std::vector<nook_nnao> single;
    for (int eye = 0; eye < eyes; ++eye) single.push_back(create_pass(fixture.gl, desc_of(settings, 0)));
    // A layer is a texture of the pass; another eye has others with means over frames alone.
    std::uint64_t one = 0, two = 0;
    const PassDesc plain_desc = desc_of(settings, 0), array_desc = desc_of(settings, eyes);
    NOOK_OK_OR_FAIL(nook_nnao_memory(&plain_desc, &one));
    NOOK_OK_OR_FAIL(nook_nnao_memory(&array_desc, &two));
    CHECK(two > one);
    CHECK((settings.temporal != 0 || two - one == std::uint64_t(width * height * channels)));
    for (const bool given : {false, true})
      for (int count = 0; count < 3; ++count) {
        ScreenFrame frame = frame_desc(both.cameras[0], width, height, depth, given ? normals : 0, 0.6f);
        frame.view_projections = both.projections.data();
        // Each eye has a movement of its own.
        float views[eyes * 16] = {};
        for (int eye = 0; eye < eyes; ++eye)
          for (int axis = 0; axis < 4; ++axis) views[16 * eye + 5 * axis] = 1;
        const auto drawn = float(given ? 3 + count : count);
        views[12] = -0.02f * drawn;
        views[16 + 12] = 0.03f * drawn;
        frame.view_matrices = views;
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        for (int eye = 0; eye < eyes; ++eye) {
          ScreenFrame alone =
              frame_desc(both.cameras[std::size_t(eye)], width, height,
                         fixture.depth_of(both.cameras[std::size_t(eye)], both.pictures[std::size_t(eye)]),
                         given ? fixture.normals_of(both.pictures[std::size_t(eye)]) : 0, 0.6f);
          std::copy_n(views + 16 * eye, 16, alone.view);
          NOOK_OK_OR_FAIL(nook_nnao_render(single[std::size_t(eye)], &alone, &alone));
          INFO("eye " << eye << ", half " << settings.half << ", means " << settings.temporal << ", frame "
                      << count);
          CHECK((layer_of(context.gl(), info_of(pass).texture, eye, channels) ==
                 read_texture(context.gl(), info_of(single[std::size_t(eye)]).texture, width, height,
                              channels)));
        }
      }
    CHECK((layer_of(context.gl(), info_of(pass).texture, 0, channels) !=
           layer_of(context.gl(), info_of(pass).texture, 1, channels)));
    nook_nnao_destroy(&pass);
    for (nook_nnao& made : single) nook_nnao_destroy(&made);
  }
}

TEST_CASE("nnao: two eyes are multiplied into the layers of the host's array, by matrices of their own") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Eyes both;
  const std::vector<float> grey(width * height * 4, 0.5f), layer_value(width * height, 0.7f),
      open(width * height, 1.0f);
  const GLuint target = fixture.textures.array(GL_RGBA8, 4, width, height, {grey, grey, grey});
  // The normals of the second eye are stored turned, which its matrix turns back.
  std::vector<std::vector<float>> stored = both.normals;
  for (std::size_t i = 0; i < stored[1].size(); i += 3) std::swap(stored[1][i], stored[1][i + 1]);
  const float matrices[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1};
  nook_nnao pass = create_pass(fixture.gl, desc_of({}, eyes)),
            plain = create_pass(fixture.gl, desc_of({}, 0));
  ScreenFrame frame = frame_desc(both.cameras[0], width, height,
                                 fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, both.depths),
                                 fixture.textures.array(GL_RGB32F, 3, width, height, stored), 0.6f);
  frame.view_projections = both.projections.data();
  frame.view_normal_matrices = matrices;
  frame.gbuffer_ao = NOOK_GBUFFER_AO_MIN;
  frame.gbuffer_ao_texture = fixture.textures.array(GL_R8, 1, width, height, {layer_value, open});
  frame.target = NOOK_TARGET_TEXTURE;
  frame.target_name = target;
  frame.blend = NOOK_BLEND_MULTIPLY;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  for (int eye = 0; eye < eyes; ++eye) {
    ScreenFrame alone =
        frame_desc(both.cameras[std::size_t(eye)], width, height,
                   fixture.depth_of(both.cameras[std::size_t(eye)], both.pictures[std::size_t(eye)]),
                   fixture.normals_of(both.pictures[std::size_t(eye)]), 0.6f);
    NOOK_OK_OR_FAIL(nook_nnao_render(plain, &alone, &alone));
    std::vector<float> wanted = own_ao(context.gl(), plain, width, height);
    for (float& ao : wanted) ao = 0.5f * (eye == 0 ? std::min(ao, 0.7f) : ao);
    // 8 bits of the target, of the layer and of the AO that is read back.
    CHECK(difference(layer_of(context.gl(), target, eye, 1), wanted, 2.0f / 255).beyond == 0);
  }
  CHECK(
      (layer_of(context.gl(), target, 2, 1) ==
       read_texture(context.gl(), fixture.textures.floats(GL_RGBA8, 4, width, height, grey), width, height)));
  nook_nnao_destroy(&pass);
  nook_nnao_destroy(&plain);
}

TEST_CASE("nnao: texture arrays are refused where they do not fit, and nothing is drawn") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Eyes both;
  const bool knows_sizes = !context.is_es() || version_of(context) >= 31;
  const GLuint depth = fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, both.depths);
  const GLuint one = fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, {both.depths[0]});
  const GLuint flat_depth = fixture.depth_of(both.cameras[0], both.pictures[0]);
  nook_nnao pass = create_pass(fixture.gl, desc_of({}, eyes));
  const GLuint own = info_of(pass).texture;
  const auto refused = [&](const ScreenFrame& frame, const char* message) {
    CHECK(nook_nnao_render(pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has(message));
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    take_debug_messages();
  };
  const ScreenFrame good = frame_desc(both.cameras[0], width, height, depth, 0, 0.6f);
  ScreenFrame bad = good;
  bad.depth_texture = flat_depth;
  refused(bad, "frame.depth_texture is a texture of another kind");
  refused(bad, "need a 2D texture array");
  bad = good, bad.depth_texture = one;
  if (knows_sizes) refused(bad, "frame.depth_texture has another size (got 1 layers, need desc.views, 2)");
  bad = good, bad.target = NOOK_TARGET_FRAMEBUFFER;
  refused(bad, "frame.target 2 cannot be combined with desc.views 2");
  bad = good, bad.target = NOOK_TARGET_TEXTURE, bad.target_name = own;
  refused(bad, "use NOOK_TARGET_OWN");
  bad = good, bad.target = NOOK_TARGET_TEXTURE, bad.target_name = depth;
  refused(bad, "frame.depth_texture is frame.target_name as well");
  std::vector<float> projections = both.projections;
  projections[16 + 5] = 0;
  bad = good, bad.view_projections = projections.data();
  refused(bad, "view 1: frame.projection is not a projection");
  nook_nnao_recording recording = nullptr;
  CHECK(nook_nnao_record(pass, &good, &good, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(recording == nullptr);
  for (int eye = 0; eye < eyes; ++eye)
    for (const float value : layer_of(context.gl(), own, eye, 1)) REQUIRE(value == 1);
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &good, &good));
  nook_nnao_destroy(&pass);
  const struct {
    int layers, samples, sample, normal_samples;
    const char* message;
  } cases[] = {{9, 0, 0, 0, "desc.views is out of range (got 9, need 0 to 8)"},
               {-1, 0, 0, 0, "desc.views is out of range"},
               {2, 4, 0, 8, "desc.normal_samples differs from desc.depth_samples (got 8 and 4"},
               {0, 0, 0, 4, "desc.normal_samples differs from desc.depth_samples (got 4 and 0"},
               {0, 4, 0, -4, "desc.normal_samples differs"},
               {0, 17, 0, 0, "desc.depth_samples is out of range (got 17, need 0 to 16)"},
               {0, -2, 0, 0, "desc.depth_samples is out of range"},
               {0, 4, 3, 0, "debug.depth_sample is unknown (got 3, need 0 to 2)"}};
  for (const auto& bad_desc : cases) {
    PassDesc desc = pass_desc(width, height);
    desc.views = bad_desc.layers;
    desc.depth_samples = bad_desc.samples;
    desc.debug.depth_sample = bad_desc.sample;
    desc.normal_samples = bad_desc.normal_samples;
    CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(pass == nullptr);
    CHECK(message_has(bad_desc.message));
  }
}

TEST_CASE(
    "nnao: a pass of texture arrays keeps the state contract, and saves and restores once for all layers") {
  NOOK_NEED_CONTEXT(context);
  const Eyes both;
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    NnaoFixture fixture(context, mode);
    const GLuint depth = fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, both.depths);
    const ScreenFrame frame = frame_desc(both.cameras[0], width, height, depth, 0, 0.6f);
    nook_nnao pass = nullptr;
    const auto check = [&](unsigned users, auto&& call) {
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      StateValues before = poison.touched();
      const StateValues untouched = poison.untouched();
      call();
      StateValues after = poison.touched();
      if (mode == NOOK_GL_STATE_DEFAULTS) before = poison.defaults(), after.erase("viewport");
      if (mode != NOOK_GL_STATE_HOST) CHECK(after == before);
      CHECK(poison.untouched() == untouched);
    };
    const unsigned uploads = context.is_es() ? unsigned{gl::texel_uploads} : 0u;
    check(gl::screen | gl::screen_layers | uploads, [&] {
      pass = create_pass(fixture.gl, desc_of({0, 1, 4}, eyes));
    });
    const unsigned compute = info_of(pass).compute ? unsigned{gl::screen_compute} : 0u;
    for (int i = 0; i < 2; ++i)
      check(gl::screen | gl::screen_layers | compute,
            [&] { NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame)); });
    nook_nnao_destroy(&pass);
  }
  NnaoFixture fixture(context);
  Trace trace(context);
  nook_gl gl = create_gl(fixture.host.handle, Trace::loader, &trace, 0, NOOK_GL_STATE_PRESERVE);
  const GLuint depth = fixture.textures.array(GL_DEPTH_COMPONENT32F, 1, width, height, both.depths);
  const ScreenFrame frame = frame_desc(both.cameras[0], width, height, depth, 0, 0.6f);
  const auto queries = [&](int layers) {
    nook_nnao pass = create_pass(gl, desc_of({}, layers));
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    trace.reset();
    const long allocations = fixture.host.allocations;
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    CHECK(fixture.host.allocations == allocations);
    CHECK(trace.calls_that_begin("glGen") == 0);
    const int count = trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs");
    nook_nnao_destroy(&pass);
    return count;
  };
  CHECK(queries(1) == queries(2));
  nook_gl_destroy(&gl);
}
