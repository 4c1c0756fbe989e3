// Bad input: a message that names the field, what came and what is needed; no OpenGL error, nothing drawn.
#include <nook/experimental/nook_stages.h>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>

#include "sdk/src/nnao/network_file.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 20, height = 12;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();

bool message_has(const std::string& part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part.c_str()) != nullptr;
}

struct Case {
  std::function<void(ScreenFrame&)> spoil;
  const char* message;
};

// OpenGL ES 3.0 tells formats of textures through a framebuffer, and does not tell sizes.
bool needs_texture_sizes(const Case& bad) {
  return std::strstr(bad.message, "has another size") != nullptr;
}

}  // namespace

TEST_CASE("nnao: a bad frame is refused with its field, and nothing is drawn") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const GladGLContext& gl = context.gl();
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  Textures& textures = fixture.textures;
  const std::vector<float> ones(width * height * 4, 1.0f);
  const GLuint depth = fixture.depth_of(camera, picture), normal = fixture.normals_of(picture);
  const GLuint small = textures.floats(GL_R32F, 1, 8, 8, ones);
  const GLuint byte = textures.floats(GL_R8, 1, width, height, ones);
  const GLuint half_float = textures.floats(GL_R16F, 1, width, height, ones);
  const GLuint colour = textures.floats(GL_RGBA8, 4, width, height, ones);
  const GLuint integer = textures.make(GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, width, height, nullptr);
  const GLuint later = textures.floats(GL_R32F, 1, width, height, ones);
  gl.BindTexture(GL_TEXTURE_2D, later);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 1);
  GLuint layered = 0, framebuffers[3] = {};
  gl.GenTextures(1, &layered);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, layered);
  gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R32F, width, height, 2, 0, GL_RED, GL_FLOAT, nullptr);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
  gl.GenFramebuffers(3, framebuffers);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers[0]);  // complete, with the depth that is read
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers[1]);  // not complete
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers[2]);  // complete, but draws nothing
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
  const GLenum nothing = GL_NONE;
  gl.DrawBuffers(1, &nothing);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  nook_nnao pass = create_pass(fixture.gl, pass_desc(width, height));
  const GLuint own = info_of(pass).texture;

  using Frame = ScreenFrame;
  const auto logarithmic = [](Frame& f) {
    f.depth_kind = NOOK_DEPTH_LOGARITHMIC;
    f.depth_log_far = 100;
  };
  const auto to = [](Frame& f, nook_target target, GLuint name) {
    f.target = target;
    f.target_name = name;
  };
  const Case cases[] = {
      {[&](Frame& f) { f.width = width + 1; },
       "frame.width and frame.height are out of range (got 21 x 12, need 1 x 1 to"},
      {[&](Frame& f) { f.height = 0; }, "(got 20 x 0"},
      {[&](Frame& f) { f.width = 16; },
       "frame.depth_texture has another size (got 20 x 12, need frame.width x frame.height, 16 x 12)"},
      {[&](Frame& f) { f.viewport[2] = 21, f.viewport[3] = 12; },
       "frame.viewport does not lie in the frame (got x 0, y 0, 21 x 12"},
      {[&](Frame& f) { f.viewport[0] = -1, f.viewport[2] = f.viewport[3] = 4; }, "frame.viewport"},
      {[&](Frame& f) { f.viewport[0] = 3; }, "frame.viewport"},
      {[&](Frame& f) { f.viewport[0] = 2147483647, f.viewport[2] = f.viewport[3] = 2147483647; },
       "frame.viewport"},
      {[&](Frame& f) { f.depth_texture = 0; }, "frame.depth_texture is 0"},
      {[&](Frame& f) { f.depth_texture = 54321; },
       "frame.depth_texture is not a texture of this OpenGL context (got 54321"},
      {[&](Frame& f) { f.depth_texture = layered; }, "frame.depth_texture is a texture of another kind"},
      {[&](Frame& f) { f.depth_texture = later; }, "frame.depth_texture does not begin at level 0"},
      {[&](Frame& f) { f.depth_texture = small; }, "frame.depth_texture has another size (got 8 x 8"},
      {[&](Frame& f) { f.depth_texture = byte; }, "need a depth format or GL_R32F for NOOK_DEPTH_HARDWARE"},
      {[&](Frame& f) { f.depth_texture = colour; },
       "frame.depth_texture has a format that does not fit (got"},
      {[&](Frame& f) { f.depth_texture = integer; }, "frame.depth_texture has a format that does not fit"},
      {[&](Frame& f) { f.depth_texture = half_float; }, "frame.depth_texture has a format that does not fit"},
      {[&](Frame& f) { f.depth_kind = NOOK_DEPTH_LINEAR; }, "need red in floats, such as GL_R32F"},
      {[&](Frame& f) { f.depth_kind = 3; }, "frame.depth_kind is unknown (got 3"},
      {[&](Frame& f) { f.depth_kind = NOOK_DEPTH_LOGARITHMIC; },
       "frame.depth_log_far is out of range (got 0, need more metres than depth_log_near)"},
      {[&](Frame& f) { logarithmic(f), f.depth_log_near = 100; },
       "frame.depth_log_far is out of range (got 100"},
      {[&](Frame& f) { logarithmic(f), f.depth_log_far = infinity; }, "frame.depth_log_far"},
      {[&](Frame& f) { logarithmic(f), f.depth_log_near = -1; },
       "frame.depth_log_near is out of range (got -1"},
      {[&](Frame& f) { logarithmic(f), f.depth_log_scale = 0; },
       "frame.depth_log_scale is out of range (got 0"},
      {[&](Frame& f) { logarithmic(f), f.depth_log_scale = not_a_number; }, "frame.depth_log_scale"},
      {[&](Frame& f) { logarithmic(f), f.projection[11] = 0, f.projection[15] = 1; },
       "frame.depth_kind 2 needs a perspective"},
      {[&](Frame& f) { logarithmic(f), f.depth_texture = half_float; },
       "a depth format or GL_R32F for NOOK_DEPTH_LOGARITHMIC"},
      {[&](Frame& f) { f.radius_kind = 3; }, "desc.radius_kind is unknown (got 3, need 0 to 2)"},
      {[&](Frame& f) { f.radius_kind = NOOK_NNAO_RADIUS_SCREEN, f.radius = 1.5f; },
       "desc.radius is out of range (got 1.5, need a share of the screen, more than 0 up to 1)"},
      {[&](Frame& f) { f.radius_kind = NOOK_NNAO_RADIUS_SCENE; },
       "desc.scene_size is out of range (got 0, need more than 0 metres)"},
      {[&](Frame& f) { f.radius_kind = NOOK_NNAO_RADIUS_SCENE, f.scene_size = infinity; }, "desc.scene_size"},
      {[&](Frame& f) { f.radius_kind = NOOK_NNAO_RADIUS_SCENE, f.scene_size = 5, f.radius = 0; },
       "need a share of the scene"},
      {[&](Frame& f) { f.clip_space = -1; }, "frame.clip_space is unknown"},
      {[&](Frame& f) { f.normal_texture = integer; }, "frame.normal_texture has a format that does not fit"},
      {[&](Frame& f) { f.normal_texture = byte; }, "frame.normal_texture has a format that does not fit"},
      {[&](Frame& f) { f.normal_scale = 0; }, "frame.normal_scale is out of range (got 0"},
      {[&](Frame& f) { f.normal_bias = not_a_number; }, "frame.normal_bias"},
      {[&](Frame& f) { std::memset(f.normal_matrix, 0, sizeof f.normal_matrix); },
       "frame.normal_matrix cannot be inverted"},
      {[&](Frame& f) { f.projection[8] = not_a_number; }, "frame.projection[8] is not finite (got nan"},
      {[&](Frame& f) { f.projection[0] = infinity; }, "frame.projection[0] is not finite"},
      {[&](Frame& f) { f.projection[5] = 0; }, "singular"},
      {[&](Frame& f) { f.projection[14] = 0; },
       "frame.projection is singular: its depth does not depend on the distance"},
      {[&](Frame& f) { f.projection[11] = 1; }, "frame.projection is left-handed"},
      {[&](Frame& f) { std::memset(f.projection, 0, sizeof f.projection); }, "frame.projection"},
      {[&](Frame& f) { f.projection[1] = 0.3f; }, "frame.projection[1] is 0.3, need 0"},
      {[&](Frame& f) { f.projection[12] = 2; }, "frame.projection[12] is 2, need 0"},
      {[&](Frame& f) { f.radius = 0; }, "desc.radius is out of range (got 0, need more than 0 metres)"},
      {[&](Frame& f) { f.radius = -1; }, "desc.radius is out of range (got -1"},
      {[&](Frame& f) { f.radius = not_a_number; }, "desc.radius"},
      {[&](Frame& f) { f.max_radius_px = 0.5f; }, "desc.max_radius_px"},
      {[&](Frame& f) { f.min_radius_px = -1; }, "desc.min_radius_px"},
      {[&](Frame& f) { f.min_radius_px = NAN; }, "desc.min_radius_px"},
      {[&](Frame& f) { f.fade_begin = -1; }, "desc.fade_begin"},
      {[&](Frame& f) { f.fade_begin = f.fade_end = 3; }, "desc.fade_end"},
      {[&](Frame& f) { f.fade_begin = 3; }, "desc.fade_end"},
      {[&](Frame& f) { f.intensity = 17; }, "desc.intensity"},
      {[&](Frame& f) { f.power = 0; }, "desc.power"},
      {[&](Frame& f) { f.sky_depth = -2; }, "frame.sky_depth"},
      {[&](Frame& f) { f.gbuffer_ao = 5; }, "frame.gbuffer_ao is unknown"},
      {[&](Frame& f) { f.gbuffer_ao = NOOK_GBUFFER_AO_MIN; }, "frame.gbuffer_ao_texture is 0"},
      {[&](Frame& f) { f.gbuffer_ao = NOOK_GBUFFER_AO_MIN, f.gbuffer_ao_texture = integer; },
       "frame.gbuffer_ao_texture has a format"},
      {[&](Frame& f) { f.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE, f.gbuffer_ao_texture = byte; },
       "need red and green for NOOK_GBUFFER_AO_REPLACE"},
      {[&](Frame& f) { f.gbuffer_ao = NOOK_GBUFFER_AO_MIN, f.gbuffer_ao_texture = own; },
       "frame.gbuffer_ao_texture is the pass's own texture as well"},
      {[&](Frame& f) { f.blend = NOOK_BLEND_MULTIPLY; }, "frame.blend 1 does not work with NOOK_TARGET_OWN"},
      {[&](Frame& f) { f.debug.show = NOOK_NNAO_VIEW_NORMALS; },
       "debug.show 3 does not work with NOOK_TARGET_OWN"},
      {[&](Frame& f) { f.debug.show = 9; }, "debug.show is unknown"},
      {[&](Frame& f) { to(f, 3, colour); }, "frame.target is unknown"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, 0); }, "frame.target_name is 0"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, own); }, "use NOOK_TARGET_OWN"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, depth); },
       "frame.depth_texture is frame.target_name as well"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, normal); },
       "frame.normal_texture is frame.target_name as well"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, small); }, "frame.target_name has another size"},
      {[&](Frame& f) { to(f, NOOK_TARGET_TEXTURE, integer); },
       "frame.target_name has a format that does not fit"},
      {[&](Frame& f) { to(f, NOOK_TARGET_FRAMEBUFFER, 777); },
       "frame.target_name is not a framebuffer of this OpenGL context (got 777"},
      {[&](Frame& f) { to(f, NOOK_TARGET_FRAMEBUFFER, framebuffers[0]); },
       "frame.depth_texture is attached to frame.target_name as well"},
      {[&](Frame& f) { to(f, NOOK_TARGET_FRAMEBUFFER, framebuffers[1]); },
       "frame.target_name cannot be drawn into"},
      {[&](Frame& f) { to(f, NOOK_TARGET_FRAMEBUFFER, framebuffers[2]); },
       "frame.target_name has no draw buffer"},
      {[&](Frame& f) { static_cast<nook_gl_frame_desc&>(f).struct_size = 20; },
       "desc.struct_size is too small"},
      {[&](Frame& f) { static_cast<nook_gl_frame_desc&>(f).next = &f; }, "desc.next is not NULL"},
      {[&](Frame& f) { static_cast<nook_nnao_frame_desc&>(f).struct_size = 20; },
       "desc.struct_size is too small"},
      {[&](Frame& f) { f.textures_changed = 2; }, "frame.textures_changed is neither on nor off (got 2"},
  };
  const bool knows_sizes = !context.is_es() || version_of(context) >= 31;
  int left_out = 0;
  for (const Case& bad : cases) {
    if (!knows_sizes && needs_texture_sizes(bad)) {
      ++left_out;
      continue;
    }
    ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.5f);
    bad.spoil(frame);
    INFO(bad.message);
    CHECK(nook_nnao_render(pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("nook_nnao_render: "));
    CHECK(message_has(bad.message));
    REQUIRE(gl.GetError() == GL_NO_ERROR);
    // The host sees the driver's complaint about the refused bind as a debug message only, and not as an
    // error.
    take_debug_messages();
  }
  if (left_out > 0)
    std::printf("%d cases need sizes of textures, which OpenGL ES 3.0 does not tell\n", left_out);
  // Nothing was drawn so far: AO is 1 everywhere, colours are as they were.
  for (const float value : own_ao(gl, pass, width, height)) REQUIRE(value == 1);
  CHECK((read_texture(gl, colour, width, height, 4) == ones));
  // A good frame still works.
  const ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.5f);
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  nook_nnao_destroy(&pass);
  gl.DeleteTextures(1, &layered);
  gl.DeleteFramebuffers(3, framebuffers);
}

TEST_CASE("nnao: a bad description of a pass is refused with its field") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const std::vector<std::byte> network = nnao::write_network(mild_network(nnao::NetworkForm::paper));
  using Desc = PassDesc;
  const struct {
    std::function<void(Desc&)> spoil;
    const char* message;
    nook_result result = NOOK_ERROR_INVALID_ARGUMENT;
  } cases[] = {
      {[](Desc& d) { d.max_width = 0; }, "desc.max_width and desc.max_height are out of range (got 0 x 12"},
      {[](Desc& d) { d.max_height = 20000; }, "desc.max_width and desc.max_height are out of range"},
      {[](Desc& d) { d.taps = 48; }, "desc.taps is unknown (got 48, need 9, 16, 32, 64, 128 or 256, or -1"},
      {[](Desc& d) { d.taps = -16; }, "desc.taps is unknown"},
      {[](Desc& d) { d.half_resolution = 2; },
       "desc.half_resolution is out of range (got 2, need 0 or 1, or -1"},
      {[](Desc& d) { d.blur = 3; }, "desc.blur is out of range (got 3, need 0 to 2, or -1"},
      {[](Desc& d) { d.blur = -2; }, "desc.blur is out of range"},
      {[](Desc& d) { d.preset = 3; }, "desc.preset is unknown (got 3, need 0 to 2)"},
      {[](Desc& d) { d.preset = -1; }, "desc.preset is unknown"},
      {[](Desc& d) { d.debug.timers = 5; }, "debug.timers"},
      {[](Desc& d) { d.debug.struct_size = 20; }, "desc.struct_size is too small (got 20"},
      {[](Desc& d) { d.debug.next = &d.debug; },
       "the list in desc.next contains two descriptors of the same type"},
      {[](Desc& d) { d.debug.type = NOOK_DESC_NNAO_FRAME_DEBUG; },
       "desc.next points to a descriptor that cannot extend this one"},
      {[](Desc& d) { d.debug.path = 3; }, "debug.path is unknown (got 3, need 0 to 2)"},
      {[](Desc& d) { d.debug.path = -1; }, "debug.path is unknown"},
      {[](Desc& d) { d.blur_sharpness = 0; }, "desc.blur_sharpness is out of range (got 0"},
      {[](Desc& d) { d.blur_sharpness = not_a_number; }, "desc.blur_sharpness"},
      {[](Desc& d) { d.network_size = 10; }, "desc.network is NULL, but desc.network_size is 10"},
      {[&](Desc& d) { d.network = network.data(), d.network_size = network.size() - 1; },
       "nook_nnao_create: ", NOOK_ERROR_BAD_FILE},
      {[&](Desc& d) { d.network = network.data(), d.network_size = 3; },
       "nook_nnao_create: ", NOOK_ERROR_BAD_FILE},
  };
  for (const auto& bad : cases) {
    PassDesc desc = pass_desc(width, height);
    bad.spoil(desc);
    nook_nnao pass = reinterpret_cast<nook_nnao>(&desc);
    INFO(bad.message);
    CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == bad.result);
    CHECK(pass == nullptr);
    CHECK(message_has(bad.message));
    std::uint64_t bytes = 7;
    if (bad.result == NOOK_ERROR_INVALID_ARGUMENT) {
      CHECK(nook_nnao_memory(&desc, &bytes) == NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(bytes == 7);
    }
  }
  PassDesc desc = pass_desc(width, height);
  nook_nnao pass = nullptr;
  CHECK(nook_nnao_create(nullptr, &desc, &pass) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_create(fixture.gl, nullptr, &pass) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_create(fixture.gl, &desc, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_render(nullptr, nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_describe(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_read_timings(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_nnao_destroy(nullptr);
}

TEST_CASE("nnao: a texture made anew under its name is seen with textures_changed") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const GLuint depth = fixture.depth_of(camera, look(camera, still_life(), width, height));
  nook_nnao pass = create_pass(fixture.gl, pass_desc(width, height));
  ScreenFrame frame = frame_desc(camera, width, height, depth, 0, 0.5f);
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const GladGLContext& gl = context.gl();
  gl.BindTexture(GL_TEXTURE_2D, depth);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 4, 4, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
  gl.BindTexture(GL_TEXTURE_2D, 0);
  frame.textures_changed = 1;
  CHECK(nook_nnao_render(pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
  // OpenGL ES 3.0 does not tell sizes, but refuses the format.
  const bool knows_sizes = !context.is_es() || version_of(context) >= 31;
  CHECK(message_has(knows_sizes ? "frame.depth_texture has another size (got 4 x 4"
                                : "frame.depth_texture has a format that does not fit"));
  nook_nnao_destroy(&pass);
}
