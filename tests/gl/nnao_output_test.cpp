// Where AO goes and what is mixed in: targets, blending, layers, strength, formats of normals, sizes from
// frame to frame.
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 40, height = 30;
constexpr float step = 1.0f / 255;

struct Output : NnaoFixture {
  explicit Output(platform::Context& made_in)
      : NnaoFixture(made_in),
        picture(look(camera, still_life(), width, height)),
        depth(depth_of(camera, picture)) {
    PassDesc desc = pass_desc(width, height);
    desc.taps = 16;
    pass = create_pass(gl, desc, mild_network(nnao::NetworkForm::horizon));
    plain = draw(frame());
  }
  ~Output() { nook_nnao_destroy(&pass); }

  ScreenFrame frame() const { return frame_desc(camera, width, height, depth, 0, 0.8f); }
  std::vector<float> draw(const ScreenFrame& frame) {
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    return own_ao(context.gl(), pass, width, height);
  }
  std::vector<float> draw_into(ScreenFrame frame, GLuint texture, int channels = 4) {
    frame.target = NOOK_TARGET_TEXTURE;
    frame.target_name = texture;
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    return read_texture(context.gl(), texture, width, height, channels);
  }

  Camera camera = plain_camera(float(width) / height);
  Picture picture;
  GLuint depth = 0;
  nook_nnao pass = nullptr;
  std::vector<float> plain;  // AO without anything
};

std::vector<float> ramp(int channels) {
  std::vector<float> values;
  for (int i = 0; i < width * height * channels; ++i) values.push_back(float(i * 7 % 101) / 100);
  return values;
}

}  // namespace

TEST_CASE("nnao: intensity and power are the formula of the header") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  for (const auto& [intensity, power] : {std::pair{0.0f, 1.0f}, {0.5f, 1.0f}, {1.0f, 2.2f}, {2.5f, 0.5f}}) {
    ScreenFrame frame = output.frame();
    frame.intensity = intensity;
    frame.power = power;
    // In floats, so that only the rounding of the pass's own 8 bits remains: of the plain result, times the
    // slope.
    const std::vector<float> raw =
        output.draw_into(output.frame(), output.textures.floats(GL_RGBA32F, 4, width, height, ramp(4)));
    const std::vector<float> found =
        output.draw_into(frame, output.textures.floats(GL_RGBA32F, 4, width, height, ramp(4)));
    for (std::size_t i = 0; i < raw.size(); i += 4) {
      const float wanted = std::pow(std::max(0.0f, 1 - intensity * (1 - raw[i])), power);
      REQUIRE(std::abs(found[i] - wanted) < 1e-4f);
      REQUIRE(found[i + 3] == 1);
    }
  }
}

TEST_CASE("nnao: each layer is the formula of the header") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  const std::vector<float> layer = ramp(2);
  const GLuint layer_texture = output.textures.floats(GL_RG32F, 2, width, height, layer);
  for (const nook_gbuffer_ao mode :
       {NOOK_GBUFFER_AO_MIN, NOOK_GBUFFER_AO_REMAINDER, NOOK_GBUFFER_AO_REPLACE}) {
    ScreenFrame frame = output.frame();
    frame.gbuffer_ao = mode;
    frame.gbuffer_ao_texture = layer_texture;
    const std::vector<float> found = output.draw(frame);
    float largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const float s = output.plain[i], c = layer[2 * i], w = layer[2 * i + 1];
      float wanted = std::min(s, c);
      if (mode == NOOK_GBUFFER_AO_REMAINDER) wanted = c > 0 ? std::min(s, c) / c : 1;
      if (mode == NOOK_GBUFFER_AO_REPLACE) wanted = (1 - w) * s + w * c;
      // s itself is known to half a step, which c divides.
      const float slack = mode == NOOK_GBUFFER_AO_REMAINDER && c > 0 ? 1 / c : 1;
      largest = std::max(largest, std::abs(found[i] - wanted) / slack);
    }
    INFO("layer " << mode);
    CHECK(largest < 1.1f * step);
  }
}

TEST_CASE("nnao: targets are written, or multiplied with their alpha kept") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  const std::vector<float> before = ramp(4);
  for (const nook_blend blend : {NOOK_BLEND_WRITE, NOOK_BLEND_MULTIPLY}) {
    ScreenFrame frame = output.frame();
    frame.blend = blend;
    const std::vector<float> found =
        output.draw_into(frame, output.textures.floats(GL_RGBA32F, 4, width, height, before));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const float ao = output.plain[i / 4];
      const bool alpha = i % 4 == 3;
      const float wanted =
          blend == NOOK_BLEND_WRITE ? (alpha ? 1 : ao) : (alpha ? before[i] : before[i] * ao);
      REQUIRE(std::abs(found[i] - wanted) < 0.6f * step);
    }
  }
}

TEST_CASE("nnao: a target with sRGB is multiplied in linear light") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  const std::vector<std::uint8_t> grey(std::size_t(width) * height * 4, 188);  // half of white, encoded
  const GLuint target =
      output.textures.make(GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height, grey.data());
  ScreenFrame frame = output.frame();
  frame.blend = NOOK_BLEND_MULTIPLY;
  const std::vector<float> found = output.draw_into(frame, target);  // read as encoded
  const auto decode = [](float v) { return std::pow((v + 0.055f) / 1.055f, 2.4f); };
  for (std::size_t i = 0; i < found.size(); i += 4) {
    if (found[i] < 0.1f) continue;
    REQUIRE(std::abs(decode(found[i]) - decode(188 * step) * output.plain[i / 4]) < 2 * step);
  }
}

TEST_CASE("nnao: a framebuffer of the host is a target") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  const GladGLContext& gl = context.gl();
  const GLuint colour = output.textures.floats(GL_RGBA32F, 4, width, height, ramp(4));
  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
  ScreenFrame frame = output.frame();
  frame.target = NOOK_TARGET_FRAMEBUFFER;
  frame.target_name = framebuffer;
  NOOK_OK_OR_FAIL(nook_nnao_render(output.pass, &frame, &frame));
  const std::vector<float> found = read_texture(gl, colour, width, height, 4);
  for (std::size_t i = 0; i < output.plain.size(); ++i)
    REQUIRE(std::abs(found[4 * i] - output.plain[i]) < 0.6f * step);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
}

TEST_CASE("nnao: normals in other encodings and spaces are the same normals") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  ScreenFrame frame = output.frame();
  frame.normal_texture = output.normals_of(output.picture);
  const std::vector<float> wanted = output.draw(frame);
  CHECK((wanted != output.plain));

  std::vector<float> encoded, turned;
  for (const Vec3 n : output.picture.normal) {
    for (const float c : {n.x, n.y, n.z}) encoded.push_back(0.5f * c + 0.5f);
    // World space whose y is the camera's z.
    for (const float c : {n.x, n.z, -n.y}) turned.push_back(3 * c);
  }
  frame.normal_texture = output.textures.floats(GL_RGB16, 3, width, height, encoded);
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  const Difference by_encoding = difference(output.draw(frame), wanted, 1.5f * step);
  CHECK(by_encoding.beyond == 0);

  frame.normal_texture = output.textures.floats(GL_RGB32F, 3, width, height, turned);
  frame.normal_scale = 1;
  frame.normal_bias = 0;
  const float to_view[9] = {1, 0, 0, 0, 0, 1, 0, -1, 0};
  std::copy(std::begin(to_view), std::end(to_view), frame.normal_matrix);
  const Difference by_space = difference(output.draw(frame), wanted, 1.5f * step);
  CHECK(by_space.beyond == 0);

  // Where nothing was drawn, the normal is rebuilt.
  frame.normal_texture = output.textures.floats(GL_RGB32F, 3, width, height,
                                                std::vector<float>(std::size_t(width) * height * 3));
  CHECK((output.draw(frame) == output.plain));
}

TEST_CASE("nnao: depth in 24 bits and in a colour texture is depth as well") {
  NOOK_NEED_CONTEXT(context);
  Output output(context);
  const std::vector<float> stored = stored_depth(output.camera, output.picture);
  ScreenFrame frame = output.frame();
  frame.normal_texture = output.normals_of(output.picture);
  const std::vector<float> wanted = output.draw(frame);
  frame.depth_texture = output.textures.floats(GL_R32F, 1, width, height, stored);
  CHECK((output.draw(frame) == wanted));
  frame.depth_texture = output.textures.floats(GL_DEPTH_COMPONENT24, 1, width, height, stored);
  // At 12 m a step of 24 bits is 0.04 mm.
  CHECK(difference(output.draw(frame), wanted, 2.5f * step).beyond < 0.01f);
}

TEST_CASE("nnao: sizes change from frame to frame as if the pass were made for each") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  for (const int half : {0, 1}) {
    PassDesc desc = pass_desc(64, 64);
    desc.half_resolution = half;
    desc.taps = 16;
    const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
    nook_nnao pass = create_pass(fixture.gl, desc, network);
    for (const auto& [w, h] : {std::pair{64, 64}, {31, 17}, {48, 64}, {1, 1}, {63, 33}}) {
      const Camera camera = plain_camera(float(w) / float(h));
      const Picture picture = look(camera, still_life(), std::uint32_t(w), std::uint32_t(h));
      const ScreenFrame frame = frame_desc(camera, w, h, fixture.depth_of(camera, picture), 0, 0.6f);
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      if (w != 31 && w != 63) continue;
      PassDesc fitting = pass_desc(w, h);
      fitting.half_resolution = half;
      fitting.taps = 16;
      nook_nnao fresh = create_pass(fixture.gl, fitting, network);
      NOOK_OK_OR_FAIL(nook_nnao_render(fresh, &frame, &frame));
      CHECK((own_ao(context.gl(), pass, w, h) == own_ao(context.gl(), fresh, w, h)));
      nook_nnao_destroy(&fresh);
    }
    nook_nnao_destroy(&pass);
  }
}
