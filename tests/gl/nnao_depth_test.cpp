// A kind of depth that no projection matrix gives: logarithmic depth.
#include <nook/experimental/nook_recording.h>
#include <cmath>

#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

// As in nnao_agreement_test.cpp: AO has 8 bits, and some 1e-4 of the taps lie on the border of two texels.
constexpr float bound = 1.0f / 255, flipped = 0.001f;
constexpr int width = 72, height = 48;

struct Logarithm {
  const char* name;
  double scale, near_m, far_m;  // C, n, f

  float stored(float depth) const {
    if (!std::isfinite(depth)) return 1;
    return float(std::log2(1 + scale * (depth - near_m)) / std::log2(1 + scale * (far_m - near_m)));
  }
};
constexpr Logarithm logarithms[] = {{"three.js", 1, 0, 40},
                                    {"three.js, far", 1, 0, 1e8},
                                    {"Cesium", 1, 0.2, 1e9},
                                    {"a finer start", 1000, 0, 1e4},
                                    {"a coarser start", 0.01, 0, 1e7}};

}  // namespace

TEST_CASE("nnao: logarithmic depth gives the AO of linear depth") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(float(width) / height);
  for (const std::size_t index : {0u, 9u, 12u})
    for (const Logarithm& logarithm : logarithms)
      for (const int half : {0, 1}) {
        const Camera& camera = all[index];
        const Picture picture = look(camera, still_life(), width, height);
        std::vector<float> stored;
        for (const float depth : picture.depth) stored.push_back(logarithm.stored(depth));
        const GLuint normals = fixture.normals_of(picture);
        nook_nnao pass = fixture.pass_of(9, half, 1, nullptr);
        ScreenFrame frame =
            frame_desc(camera, width, height,
                       fixture.textures.floats(GL_R32F, 1, width, height, picture.depth), normals, 0.5f);
        frame.depth_kind = NOOK_DEPTH_LINEAR;
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        const std::vector<float> wanted = own_ao(context.gl(), pass, width, height);
        frame.depth_kind = NOOK_DEPTH_LOGARITHMIC;
        frame.depth_log_scale = float(logarithm.scale);
        frame.depth_log_near = float(logarithm.near_m);
        frame.depth_log_far = float(logarithm.far_m);
        for (const GLint format : {GL_R32F, GL_DEPTH_COMPONENT32F}) {
          frame.depth_texture = fixture.textures.floats(format, 1, width, height, stored);
          NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
          const std::vector<float> found = own_ao(context.gl(), pass, width, height);
          const Difference d = difference(found, wanted, bound);
          INFO(camera.name << ", " << logarithm.name << ", half " << half << ", format " << format
                           << ": largest " << d.largest << ", beyond " << d.beyond);
          // A 32-bit float of the logarithm keeps a depth of some metres to 1e-6 of it, which moves taps and
          // edges of a few pixels more than those on borders.
          CHECK(d.beyond <= 5 * flipped);
          CHECK(d.mean < 0.2f * bound);
          for (std::size_t i = 0; i < found.size(); ++i)
            if (!std::isfinite(picture.depth[i])) REQUIRE(found[i] == 1);
        }
      }
}

TEST_CASE("nnao: logarithmic depth is recorded as linear depth, a share of the scene as metres") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  std::vector<float> stored;
  for (const float depth : picture.depth) stored.push_back(logarithms[1].stored(depth));
  ScreenFrame frame = frame_desc(camera, width, height,
                                 fixture.textures.floats(GL_R32F, 1, width, height, stored), 0, 0.125f);
  frame.depth_kind = NOOK_DEPTH_LOGARITHMIC;
  frame.depth_log_far = float(logarithms[1].far_m);
  frame.radius_kind = NOOK_NNAO_RADIUS_SCENE;
  frame.scene_size = 4;
  nook_nnao_recording recording = nullptr;
  nook_nnao_recording_desc desc{};
  desc.struct_size = sizeof desc;
  const auto record = [&] {
    nook_nnao_recording_destroy(&recording);
    NOOK_OK_OR_FAIL(nook_nnao_record(fixture.pass_of(9, 0, 1, nullptr), &frame, &frame, nullptr, &recording));
    NOOK_OK_OR_FAIL(nook_nnao_recording_describe(recording, &desc));
  };
  record();
  CHECK(desc.depth_kind == NOOK_DEPTH_LINEAR);
  CHECK(desc.radius == 0.5f);
  CHECK(desc.radius_kind == NOOK_NNAO_RADIUS_METRES);
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    // The logarithm of up to 1e8 m in 32-bit floats keeps 27 / 2^24 of a depth.
    if (std::isfinite(picture.depth[i]))
      CHECK(std::abs(desc.depth[i] - picture.depth[i]) < 3e-6f * picture.depth[i]);
    else
      CHECK(std::isinf(desc.depth[i]));
  }
  frame.radius_kind = NOOK_NNAO_RADIUS_SCREEN;
  record();
  CHECK(desc.radius == 0.125f);
  CHECK(desc.radius_kind == NOOK_NNAO_RADIUS_SCREEN);
  nook_nnao_recording_destroy(&recording);
}
