// The pass gives the AO of the CPU reference: every projection, both forms, odd sizes, parts of an image.
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

// The pass keeps AO in 8 bits (half a step off at most) and normals in 2 x 16; half a step more for its
// arithmetic.
constexpr float bound = 1.0f / 255;
// Taps that fall on the border of two texels may land on either side under another order of rounding; a
// flipped tap moves AO by more than the bound. Of random taps some 1e-4 lie so near a border.
constexpr float flipped = 0.001f;

float spread(const std::vector<float>& ao) {
  float low = 1, high = 0;
  for (const float value : ao) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high - low;
}

struct Setting {
  nnao::NetworkForm form = nnao::NetworkForm::horizon;
  std::uint32_t taps = 16;
  float radius = 1.2f;
  float max_radius_px = 0;
};

std::vector<float> reference(const nnao::Network& network, const Picture& picture, const Setting& setting,
                             float max_radius_px) {
  std::vector<float> ao(picture.depth.size());
  nnao::evaluate(network, picture.view(), {setting.radius, max_radius_px, setting.taps}, ao);
  return ao;
}

struct Fixture : NnaoFixture {
  using NnaoFixture::NnaoFixture;

  // Raw AO of a picture by the pass against the reference.
  void compare(const Camera& camera, const Setting& setting, std::uint32_t width, std::uint32_t height,
               bool linear_depth = false) {
    const nnao::Network network = mild_network(setting.form);
    const Picture picture = look(camera, still_life(), width, height);
    const int w = int(width), h = int(height);
    nook_nnao pass = pass_of(int(setting.taps), 0, 1, &network);
    const GLuint depth = linear_depth
                             ? textures.floats(GL_R32F, 1, w, h, picture.depth)
                             : textures.floats(GL_DEPTH_COMPONENT32F, 1, w, h, stored_depth(camera, picture));
    const GLuint normal = textures.floats(GL_RGB32F, 3, w, h, flat(picture.normal));
    ScreenFrame frame = frame_desc(camera, w, h, depth, normal, setting.radius);
    frame.debug.show = NOOK_NNAO_VIEW_RAW;
    frame.max_radius_px = setting.max_radius_px;
    frame.depth_kind = linear_depth ? NOOK_DEPTH_LINEAR : NOOK_DEPTH_HARDWARE;
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    const float max_px =
        setting.max_radius_px > 0 ? setting.max_radius_px : std::max(0.25f * float(height), 1.0f);
    const std::vector<float> wanted = reference(network, picture, setting, max_px);
    const Difference found = difference(own_ao(context.gl(), pass, w, h), wanted, bound);
    INFO(camera.name << ", " << width << " x " << height << ", " << setting.taps << " taps, form "
                     << int(setting.form) << ": largest " << found.largest << ", mean " << found.mean);
    CHECK(found.beyond <= flipped);
    CHECK(found.mean < 0.5f * bound);
    // Nothing lies within 1 cm of another thing.
    if (width > 16 && setting.radius > 0.01f) CHECK(spread(wanted) > 0.1f);
  }
};

}  // namespace

TEST_CASE("nnao: the pass agrees with the reference under every projection") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper})
    for (const Camera& camera : cameras(80.0f / 45)) fixture.compare(camera, {form}, 80, 45);
}

TEST_CASE("nnao: the pass agrees with the reference on linear depth") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const std::vector<Camera> all = cameras(80.0f / 45);
  for (const std::size_t camera : {0u, 2u, 6u, 9u}) fixture.compare(all[camera], {}, 80, 45, true);
}

TEST_CASE("nnao: the pass agrees with the reference for every number of taps") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper})
    for (const std::uint32_t taps : {9u, 16u, 32u, 64u, 128u, 256u})
      fixture.compare(plain_camera(1.5f), {form, taps, 0.8f}, 48, 32);
}

TEST_CASE("nnao: the pass agrees with the reference at odd sizes and radii") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {1u, 17u}, {61u, 37u}})
    fixture.compare(plain_camera(float(width) / float(height)), {}, width, height);
  for (const float radius : {0.01f, 3.0f, 100.0f})
    fixture.compare(plain_camera(1.5f), {nnao::NetworkForm::horizon, 32, radius, 40}, 60, 40);
}

TEST_CASE("nnao: a part of an image is the same picture, and nothing outside it is written") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), 45, 30);
  const Place place{64, 50, 7, 11};
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
  for (const int half : {0, 1}) {
    nook_nnao pass = fixture.pass_of(16, half, 1, &network);
    const auto draw = [&](const Place& at) {
      const GLuint depth = fixture.textures.floats(
          GL_DEPTH_COMPONENT32F, 1, at.width, at.height,
          placed(stored_depth(camera, picture), 1, picture, at, 0.3f));  // outside lies a near wall
      const GLuint target = fixture.textures.floats(
          GL_R32F, 1, at.width, at.height, std::vector<float>(std::size_t(at.width) * at.height, 0.7f));
      ScreenFrame frame = frame_desc(camera, at.width, at.height, depth, 0, 0.5f);
      frame.viewport[0] = at.x;
      frame.viewport[1] = at.y;
      frame.viewport[2] = int(picture.width);
      frame.viewport[3] = int(picture.height);
      frame.target = NOOK_TARGET_TEXTURE;
      frame.target_name = target;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      return read_texture(fixture.context.gl(), target, at.width, at.height);
    };
    const std::vector<float> alone = draw({int(picture.width), int(picture.height), 0, 0});
    CHECK((draw(place) == placed(alone, 1, picture, place, 0.7f)));
  }
}

TEST_CASE("nnao: half resolution is the reference on every second pixel") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const Camera& camera : {cameras(1.5f)[0], cameras(1.5f)[6], cameras(1.5f)[9]})
    for (const auto& [width, height] : {std::pair{72, 48}, {73, 47}}) {
      const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
      const Picture picture = look(camera, still_life(), std::uint32_t(width), std::uint32_t(height));
      nook_nnao pass = fixture.pass_of(32, 1, 1, &network);
      const GLuint depth =
          fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, stored_depth(camera, picture));
      const GLuint normal = fixture.textures.floats(GL_RGB32F, 3, width, height, flat(picture.normal));
      ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.6f);
      frame.debug.show = NOOK_NNAO_VIEW_RAW;
      frame.max_radius_px = 20;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      const std::vector<float> ao = own_ao(context.gl(), pass, width, height);
      std::vector<float> even;
      for (int y = 0; y < height; y += 2)
        for (int x = 0; x < width; x += 2) even.push_back(ao[std::size_t(y) * width + x]);
      const Picture half = halved(picture);
      std::vector<float> wanted(half.depth.size());
      nnao::evaluate(network, half.view(), {0.6f, 10, 32}, wanted);
      // These pixels are the surface's own; their neighbours come in with a thousandth each.
      const Difference found = difference(even, wanted, 2 * bound);
      INFO(camera.name << ", " << width << " x " << height << ": largest " << found.largest << ", mean "
                       << found.mean);
      CHECK(found.beyond <= flipped);
      CHECK(found.mean < bound);
    }
}
