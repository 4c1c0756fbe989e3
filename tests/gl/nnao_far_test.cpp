// The minimum of the radius in pixels, and the fade of AO by distance.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

// As in nnao_agreement_test.cpp: AO has 8 bits, and some 1e-4 of the taps lie on the border of two texels.
constexpr float bound = 1.0f / 255, flipped = 0.001f;
constexpr int width = 72, height = 48;

// A wall that stands on a floor, seen by a camera 1.7 m above the floor: a strip of a view of 1080 rows and
// 60 degrees.
constexpr int columns = 16, rows = 64;
constexpr float focal_px = 935, eye_m = 1.7f;

struct Foot {
  Picture picture;
  float view[16];
  std::size_t pixel = 0;  // the lowest of the wall
};

Foot foot_of_a_wall(float distance_m, float pitch) {
  Foot foot{{columns, rows, {}, {}, {}}, {}};
  foot.picture.rays = {1 / focal_px, -0.5f * columns / focal_px, 1 / focal_px, -0.5f * rows / focal_px,
                       false};
  const float c = std::cos(pitch), s = std::sin(pitch);
  const float view[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, -c * eye_m, -s * eye_m, 1};
  std::memcpy(foot.view, view, sizeof view);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Vec3 at_1 = nnao::view_position(foot.picture.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      const float up = at_1.y * c - s, ahead = at_1.y * s + c;
      const float to_wall = distance_m / ahead, to_floor = up < 0 ? eye_m / -up : INFINITY;
      const bool wall = to_wall < to_floor;
      if (wall && foot.pixel == 0 && x == columns / 2) foot.pixel = foot.picture.depth.size();
      foot.picture.depth.push_back(std::min(to_wall, to_floor));
      foot.picture.normal.push_back(wall ? Vec3{0, -s, c} : Vec3{0, c, s});
    }
  return foot;
}

struct FarFixture : NnaoFixture {
  using NnaoFixture::NnaoFixture;

  // The most by which AO of the wall's foot differs while the camera turns by 0.01 radians.
  float swing(float distance_m, float min_radius_px, int half, int history) {
    PassDesc desc = pass_desc(columns, rows);
    desc.half_resolution = half;
    desc.max_history_frames = history;
    nook_nnao pass = create_pass(gl, desc);
    float low = 1, high = 0;
    constexpr int steps = 32;
    for (int step = 0; step < steps; ++step) {
      const float turn = 0.01f * (float(step) / steps - 0.5f);
      const Foot foot = foot_of_a_wall(distance_m, std::atan(eye_m / distance_m) + turn);
      Textures images(context.gl());
      ScreenFrame frame =
          frame_desc({}, columns, rows, images.floats(GL_R32F, 1, columns, rows, foot.picture.depth),
                     images.floats(GL_RGB32F, 3, columns, rows, flat(foot.picture.normal)), 0.5f);
      const float projection[16] = {
          2 * focal_px / columns, 0, 0, 0, 0, 2 * focal_px / rows, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
      std::memcpy(frame.projection, projection, sizeof projection);
      std::memcpy(frame.view, foot.view, sizeof foot.view);
      frame.depth_kind = NOOK_DEPTH_LINEAR;
      frame.max_radius_px = 270;
      frame.min_radius_px = min_radius_px;
      frame.textures_changed = 1;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      const float ao = own_ao(context.gl(), pass, columns, rows)[foot.pixel];
      // A mean of frames has settled after half of them.
      if (history && step < steps / 2) continue;
      low = std::min(low, ao);
      high = std::max(high, ao);
    }
    nook_nnao_destroy(&pass);
    return high - low;
  }
};

nook_nnao_frame_desc defaults() {
  nook_nnao_frame_desc desc;
  NOOK_OK_OR_FAIL(nook_nnao_frame_desc_init(&desc));
  return desc;
}

}  // namespace

TEST_CASE("nnao: a minimum in pixels and a fade by distance are the reference's") {
  NOOK_NEED_CONTEXT(context);
  FarFixture fixture(context);
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper}) {
    const nnao::Network network = mild_network(form);
    for (const std::size_t index : {0u, 5u, 6u}) {
      const Camera camera = cameras(float(width) / height)[index];
      const Picture picture = look(camera, still_life(), width, height);
      for (const bool fades : {false, true}) {
        ScreenFrame frame = frame_desc(camera, width, height, fixture.depth_of(camera, picture),
                                       fixture.normals_of(picture), 0.4f);
        frame.debug.show = NOOK_NNAO_VIEW_RAW;
        frame.min_radius_px = 6;
        nnao::Sampling sampling{0.4f, 0.25f * height, 16, 6, {}};
        if (fades) {
          frame.fade_begin = 2;
          frame.fade_end = 6;
          sampling.fade = nnao::distance_fade(2, 6);
        }
        nook_nnao pass = fixture.pass_of(16, 0, 1, &network);
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        const std::vector<float> found = own_ao(context.gl(), pass, width, height);
        std::vector<float> wanted(found.size());
        nnao::evaluate(network, picture.view(), sampling, wanted);
        const Difference d = difference(found, wanted, bound);
        INFO(camera.name << ", form " << int(form) << ", fade " << fades << ": largest " << d.largest);
        CHECK(d.beyond <= flipped);
        CHECK(d.mean < 0.5f * bound);
        for (std::size_t i = 0; i < found.size(); ++i)
          if (fades && picture.depth[i] >= 6) REQUIRE(found[i] == 1);
      }
    }
  }
}

TEST_CASE("nnao: a minimum leaves every bit where the radius covers more pixels") {
  NOOK_NEED_CONTEXT(context);
  FarFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  for (const int half : {0, 1})
    for (const int blur : {0, 1}) {
      nook_nnao pass = fixture.pass_of(9, half, blur, nullptr);
      const auto drawn = [&](float min_radius_px) {
        ScreenFrame frame = frame_desc(camera, width, height, fixture.depth_of(camera, picture), 0, 1.2f);
        frame.min_radius_px = min_radius_px;
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        return own_ao(context.gl(), pass, width, height);
      };
      // 1.2 m at 7 m are 5.7 pixels.
      CHECK((drawn(5.5f) == drawn(0)));
      CHECK_FALSE((drawn(12) == drawn(0)));
    }
}

TEST_CASE("nnao: AO at the foot of a far wall swings less with the minimum in pixels", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  FarFixture fixture(context);
  const float by_default = defaults().min_radius_px;
  // The network's AO of a right angle is not below this.
  constexpr float darkest = 0.35f;
  for (const int half : {0, 1})
    for (const int history : {0, 8}) {
      float sum_without = 0, sum_with = 0;
      for (const float distance_m : {5.0f, 20.0f, 75.0f, 100.0f, 150.0f, 200.0f}) {
        const float without = fixture.swing(distance_m, 0, half, history),
                    with = fixture.swing(distance_m, by_default, half, history);
        INFO("at " << distance_m << " m, half " << half << ", history " << history << ": " << without
                   << " to " << with);
        // The radius covers this share of the minimum, and so much of the darkness is left.
        const float share = focal_px * 0.5f / distance_m / by_default;
        if (share >= 1) CHECK(with == without);
        if (share >= 1) continue;
        CHECK(with <= share * (1 - darkest) + bound);
        sum_without += without;
        sum_with += with;
      }
      INFO("half " << half << ", history " << history << ": " << sum_without << " to " << sum_with);
      // At half resolution fewer samples of the wall's foot meet the floor at all.
      CHECK(sum_with <= (half ? 0.9f : 0.6f) * sum_without);
    }
}
