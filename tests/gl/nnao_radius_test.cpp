// Radii as a share of the screen or of the scene, and scenes in other units of length.
#include <algorithm>

#include "sdk/src/nnao/filter.h"
#include "sdk/src/nnao/frame_radius.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

// As in nnao_agreement_test.cpp: AO has 8 bits, and some 1e-4 of the taps lie on the border of two texels.
constexpr float bound = 1.0f / 255, flipped = 0.001f;
constexpr int width = 72, height = 48;

struct Fixture : NnaoFixture {
  using NnaoFixture::NnaoFixture;

  ScreenFrame linear(const Camera& camera, const Picture& picture, float scale, bool normals) {
    std::vector<float> depth = picture.depth;
    for (float& metres : depth) metres *= scale;
    ScreenFrame frame = frame_desc(camera, width, height, textures.floats(GL_R32F, 1, width, height, depth),
                                   normals ? normals_of(picture) : 0, 0.5f);
    frame.depth_kind = NOOK_DEPTH_LINEAR;
    return frame;
  }
  std::vector<float> draw(nook_nnao pass, const ScreenFrame& frame) {
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    return own_ao(context.gl(), pass, width, height);
  }
};

}  // namespace

TEST_CASE("nnao: a radius as a share of the screen is the reference's at each depth") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper}) {
    const nnao::Network network = mild_network(form);
    const std::vector<Camera> all = cameras(float(width) / height);
    for (const std::size_t index : {0u, 5u, 6u, 9u})
      for (const float share : {0.05f, 0.3f}) {
        const Camera& camera = all[index];
        const Picture picture = look(camera, still_life(), width, height);
        ScreenFrame frame = frame_desc(camera, width, height, fixture.depth_of(camera, picture),
                                       fixture.normals_of(picture), share);
        frame.radius_kind = NOOK_NNAO_RADIUS_SCREEN;
        frame.debug.show = NOOK_NNAO_VIEW_RAW;
        const std::vector<float> found = fixture.draw(fixture.pass_of(16, 0, 1, &network), frame);
        std::vector<float> wanted(picture.depth.size());
        nnao::evaluate(network, picture.view(), {nnao::endless_radius, share * height, 16}, wanted);
        const Difference d = difference(found, wanted, bound);
        INFO(camera.name << ", share " << share << ", form " << int(form) << ": largest " << d.largest);
        CHECK(d.beyond <= flipped);
        CHECK(d.mean < 0.5f * bound);
        // A limit in pixels holds here as well.
        frame.max_radius_px = 7;
        const std::vector<float> limited = fixture.draw(fixture.pass_of(16, 0, 1, &network), frame);
        nnao::evaluate(network, picture.view(), {nnao::endless_radius, std::min(share * height, 7.0f), 16},
                       wanted);
        CHECK(difference(limited, wanted, bound).beyond <= flipped);
      }
  }
}

TEST_CASE(
    "nnao: a radius as a share of the screen sees no difference between a scene and a larger one far away",
    "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  for (const int half : {0, 1})
    for (const int blur : {0, 1, 2})
      for (const bool normals : {true, false}) {
        nook_nnao pass = fixture.pass_of(9, half, blur, nullptr);
        std::vector<float> first;
        // Powers of two scale every number of the arithmetic exactly, but for sky.
        for (const float scale : {1.0f, 16.0f, 1.0f / 8}) {
          ScreenFrame frame = fixture.linear(camera, picture, scale, normals);
          frame.radius_kind = NOOK_NNAO_RADIUS_SCREEN;
          frame.radius = 0.15f;
          const std::vector<float> ao = fixture.draw(pass, frame);
          if (first.empty()) first = ao;
          INFO("scale " << scale << ", half " << half << ", blur " << blur << ", normals " << normals);
          const auto [low, high] = std::minmax_element(ao.begin(), ao.end());
          CHECK(*high - *low > 0.2f);
          // Drivers that divide or take roots inexactly may turn the last of the 8 bits.
          CHECK(difference(ao, first, bound).beyond <= flipped);
        }
      }
}

TEST_CASE("nnao: lengths may have any unit, if all of them have it") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  for (const int half : {0, 1}) {
    nook_nnao pass = fixture.pass_of(9, half, 1, nullptr);
    ScreenFrame metres = fixture.linear(camera, picture, 1, false);
    metres.sky_depth = 6.5f;
    const std::vector<float> wanted = fixture.draw(pass, metres);
    for (const float scale : {1000.0f, 0.001f}) {
      ScreenFrame other = fixture.linear(camera, picture, scale, false);
      other.radius = metres.radius * scale;
      other.sky_depth = metres.sky_depth * scale;
      INFO("scale " << scale << ", half " << half);
      // Depths are rounded otherwise, which moves taps and edges of some more pixels than those on borders.
      CHECK(difference(fixture.draw(pass, other), wanted, bound).beyond <= 0.01f);
    }
  }
}

TEST_CASE("nnao: a radius relative to the scene gives the same AO as this radius in metres") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  nook_nnao pass = fixture.pass_of(9, 0, 1, nullptr);
  ScreenFrame frame = fixture.linear(camera, picture, 1, true);
  const std::vector<float> wanted = fixture.draw(pass, frame);
  frame.radius_kind = NOOK_NNAO_RADIUS_SCENE;
  frame.radius = 0.0625f;
  frame.scene_size = 8;
  CHECK((fixture.draw(pass, frame) == wanted));
}

TEST_CASE("nnao: the edges of a radius in pixels follow its metres at each depth") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  // The orthographic projection has the same number of pixels for a metre at each depth, so that both kinds
  // of radius are one frame.
  const Camera camera = cameras(float(width) / height)[6];
  const Picture picture = look(camera, still_life(), width, height);
  const float px_per_metre = std::abs(nnao::pixel_scale(picture.rays, 1).y);
  for (const int half : {0, 1}) {
    nook_nnao pass = fixture.pass_of(9, half, 1, nullptr);
    ScreenFrame frame = fixture.linear(camera, picture, 1, false);
    frame.radius = 6 / px_per_metre;
    const std::vector<float> wanted = fixture.draw(pass, frame);
    frame.radius_kind = NOOK_NNAO_RADIUS_SCREEN;
    frame.radius = 6.0f / height;
    CHECK(difference(fixture.draw(pass, frame), wanted, bound).beyond <= flipped);
  }
}
