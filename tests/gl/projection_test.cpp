// frame.projection: the projections of engines pass in every call that takes a frame, and other matrices are
// refused by name.
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_stages.h>

#include <limits>

#include "sdk/src/nnao/recording.h"
#include "tests/gl/real_projections.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int size = 8;

// Every call that takes a nook_gl_frame_desc.
struct Calls {
  explicit Calls(platform::Context& made_in) : fixture(made_in) {
    depth = fixture.textures.floats(GL_R32F, 1, size, size, std::vector<float>(size * size, 0.9f));
    const std::vector<std::vector<float>> eyes(2, std::vector<float>(size * size, 0.9f));
    eye_depth = fixture.textures.array(GL_R32F, 1, size, size, eyes);
    PassDesc desc = pass_desc(size, size);
    desc.taps = 9;
    screen = create_pass(fixture.gl, desc);
    NOOK_OK_OR_FAIL(nook_nnao_stages_create(fixture.host.handle, &desc, &stages));
    desc.views = 2;
    views = create_pass(fixture.gl, desc);
    const nook_world_desc world_desc = world::world_desc(size, size);
    NOOK_OK_OR_FAIL(nook_world_create(fixture.gl, &world_desc, &world));
  }
  ~Calls() {
    nook_nnao_destroy(&screen);
    nook_nnao_destroy(&views);
    nook_nnao_stages_destroy(&stages);
    nook_world_destroy(&world);
  }

  ScreenFrame frame_of(const RealProjection& projection) const {
    ScreenFrame frame;
    frame.width = frame.height = size;
    frame.depth_texture = depth;
    frame.radius = 1;
    frame.clip_space = projection.clip;
    projection.copy_to(frame.projection);
    return frame;
  }

  // The messages of all calls, empty where a call took the frame.
  std::vector<std::string> messages_of(ScreenFrame frame) {
    std::vector<std::string> messages;
    const auto note = [&](nook_result result) {
      messages.push_back(result == NOOK_OK ? "" : nook_last_message());
      if (result != NOOK_OK) CHECK(result == NOOK_ERROR_INVALID_ARGUMENT);
    };
    note(nook_nnao_render(screen, &frame, &frame));
    auto values = nook_nnao_frame_values{};
    values.struct_size = sizeof values;
    note(nook_nnao_stages_frame(stages, &frame, &frame, nullptr, 0, 0, &values));
    note(nook_nnao_stages_frame(stages, &frame, &frame, &frame, 1, 0, &values));
    nook_nnao_recording recording = nullptr;
    note(nook_nnao_record(screen, &frame, &frame, nullptr, &recording));
    nook_nnao_recording_destroy(&recording);
    DarkenedFrame darkened(frame);
    note(nook_world_render(world, &darkened, &darkened));
    frame.depth_texture = eye_depth;
    // The second view has the projection, the first one a sound one.
    float both[32];
    std::copy_n(plain_camera(1).projection, 16, both);
    if (frame.clip_space == NOOK_CLIP_SPACE_ZERO_TO_ONE) std::copy_n(frame.projection, 16, both);
    std::copy_n(frame.projection, 16, both + 16);
    frame.view_projections = both;
    note(nook_nnao_render(views, &frame, &frame));
    return messages;
  }

  void check_taken(const RealProjection& projection) {
    INFO(projection.source);
    for (const std::string& message : messages_of(frame_of(projection))) CHECK(message == "");
  }
  void check_refused(const RealProjection& projection, const std::string& text,
                     nook_depth_kind kind = NOOK_DEPTH_HARDWARE) {
    INFO(projection.source);
    ScreenFrame frame = frame_of(projection);
    frame.depth_kind = kind;
    for (const std::string& message : messages_of(frame)) {
      INFO(message);
      CHECK(message.find(text) != std::string::npos);
    }
  }

  NnaoFixture fixture;
  GLuint depth = 0, eye_depth = 0;
  nook_nnao screen = nullptr, views = nullptr;
  nook_nnao_stages stages = nullptr;
  nook_world world = nullptr;
};

constexpr auto both_signs = NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE, zero_to_one = NOOK_CLIP_SPACE_ZERO_TO_ONE;

Matrix4 turned_about_y(double radians, const std::array<double, 3>& to = {}) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, to[0], to[1], to[2], 1};
}
Matrix4 scaled(double factor, const std::array<double, 3>& to = {}) {
  return {factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, factor, 0, to[0], to[1], to[2], 1};
}
Matrix4 left_handed(Matrix4 m) {
  for (std::size_t i = 8; i < 12; ++i) m[i] = -m[i];
  return m;
}

}  // namespace

TEST_CASE("projection: matrices of engines and libraries pass in every call") {
  NOOK_NEED_CONTEXT(context);
  Calls calls(context);
  const std::vector<RealProjection> all = real_projections();
  REQUIRE(all.size() >= 40);
  for (const RealProjection& projection : all) calls.check_taken(projection);
}

TEST_CASE("projection: a transposed one is refused in every call, and named") {
  NOOK_NEED_CONTEXT(context);
  Calls calls(context);
  std::size_t refused = 0;
  for (RealProjection projection : real_projections()) {
    const Matrix4 turned = transposed(projection.matrix);
    if (turned == projection.matrix) continue;  // a symmetric matrix is right either way
    ++refused;
    projection.matrix = turned;
    calls.check_refused(projection, "frame.projection is transposed");
    if (projection.clip == both_signs)
      calls.check_refused(projection, "frame.projection is transposed", NOOK_DEPTH_LINEAR);
  }
  CHECK(refused >= 40);
  RealProjection hand{"left-handed", transposed(left_handed(gl_frustum(-1, 1, -1, 1, 0.5, 40)))};
  calls.check_refused(hand, "frame.projection is transposed");
}

TEST_CASE("projection: other matrices are refused in every call, and named") {
  NOOK_NEED_CONTEXT(context);
  Calls calls(context);
  const Matrix4 plain = glu_perspective(60, 1.5, 0.1, 100), box = gl_ortho(-4, 4, -3, 3, 0.1, 30);
  Matrix4 not_finite = plain;
  not_finite[14] = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 3> aside{1, 2, -3};
  const struct {
    RealProjection projection;
    const char* text;
  } cases[] = {
      {{"nothing was copied", {}}, "frame.projection is all zeros"},
      {{"a number that is none", not_finite}, "frame.projection[14] is not finite"},
      {{"the identity", scaled(1)}, "the identity, or a world or view matrix"},
      {{"the identity, zero to one", scaled(1), zero_to_one}, "the identity, or a world or view matrix"},
      {{"a translation", scaled(1, aside)}, "the identity, or a world or view matrix"},
      {{"an object in centimetres", scaled(0.01, aside)}, "frame.projection is"},
      {{"a large object", scaled(25, aside)}, "the identity, or a world or view matrix"},
      {{"a view matrix", turned_about_y(0.4, aside)}, "the identity, or a world or view matrix"},
      {{"a transposed view matrix", transposed(turned_about_y(0.4, aside))}, "frame.projection"},
      {{"a view-projection", product(plain, turned_about_y(0.4, aside))}, "not multiplied by a view matrix"},
      {{"a view-projection that only moves", product(plain, scaled(1, aside))},
       "not multiplied by a view matrix"},
      {{"a view-projection that only turns", product(plain, turned_about_y(-1.1))},
       "not multiplied by a view matrix"},
      {{"an orthographic view-projection", product(box, turned_about_y(0.3))},
       "not multiplied by a view matrix"},
      {{"a wide orthographic view-projection",
        product(gl_ortho(-4e7, 4e7, -3e7, 3e7, 10, 9e7), turned_about_y(0.3))},
       "not multiplied by a view matrix"},
      {{"a view-projection that rolls",
        product(plain, {0.8, 0.6, 0, 0, -0.6, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})},
       "not multiplied by a view matrix"},
      {{"a view-projection that looks down",
        product(plain, {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -5, 1})},
       "frame.projection"},
      {{"the inverse", {0.9, 0, 0, 0, 0, 0.6, 0, 0, 0, 0, 0, -4.995, 0, 0, -1, 5.005}},
       "frame.projection is an inverse projection"},
      {{"left-handed", left_handed(plain)}, "frame.projection is left-handed"},
      {{"left-handed, zero to one", left_handed(d3d_frustum(-1, 1, -1, 1, 1, 50)), zero_to_one},
       "frame.projection is left-handed"},
      {{"left-handed, orthographic", left_handed(box)}, "frame.projection is left-handed"},
      {{"left-handed, orthographic, zero to one", left_handed(d3d_ortho(-4, 4, -3, 3, 0, 30)), zero_to_one},
       "frame.projection is left-handed"},
      {{"a singular one", perspective_of(0, 1, 0, 0, -1, -0.2)}, "singular"},
      {{"planes behind the camera", perspective_of(1, 1, 0, 0, -1, 0.2)},
       "frame.projection has its near or far plane behind the camera"},
  };
  for (const auto& [projection, text] : cases) calls.check_refused(projection, text);
}

TEST_CASE("projection: a recording of an oblique one gives the CPU the depths that were drawn") {
  const std::vector<Camera> all = cameras(1.5f);
  for (std::size_t i = all.size() - 2; i < all.size(); ++i) {
    const Camera& camera = all[i];
    INFO(camera.name);
    REQUIRE(camera.name.find("oblique") != std::string::npos);
    const Picture picture = look(camera, still_life(), 60, 40);
    nnao::Recording recording;
    recording.width = 60;
    recording.height = 40;
    recording.frame.clip = camera.clip;
    std::copy_n(camera.projection, 16, recording.frame.projection);
    const std::vector<float> stored = stored_depth(camera, picture);
    recording.depth.assign(stored.begin(), stored.end());
    const std::vector<float> found = nnao::view_depths(recording);
    // A step of a float below 1 is 6e-8, which with a near plane of 0.3 m is 1e-5 m at 7 m; the coefficients
    // are rounded as well.
    for (std::size_t pixel = 0; pixel < found.size(); ++pixel)
      if (std::isfinite(picture.depth[pixel]))
        REQUIRE(std::abs(found[pixel] - picture.depth[pixel]) < 1e-4f * picture.depth[pixel]);
      else
        REQUIRE(std::isinf(found[pixel]));
  }
}

TEST_CASE("projection: reversed depth with the other clip range is refused, and the range is named") {
  NOOK_NEED_CONTEXT(context);
  Calls calls(context);
  for (const double f : {7.0, 100.0, 20000.0, HUGE_VAL}) {
    RealProjection projection{"reversed, far plane " + std::to_string(f),
                              reversed_zero_to_one(glu_perspective(60, 1.5, 0.1, 100), 0.1, f), zero_to_one};
    calls.check_taken(projection);
    projection.clip = both_signs;
    calls.check_refused(projection, "set frame.clip_space to NOOK_CLIP_SPACE_ZERO_TO_ONE");
  }
  for (const double f : {10.0, 100.0, 20000.0}) {
    RealProjection projection{"reversed, -1 to 1", glu_perspective(60, 1.5, f, 0.1)};
    calls.check_taken(projection);
    projection.clip = zero_to_one;
    calls.check_refused(projection, "set frame.clip_space to NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE");
  }
}
