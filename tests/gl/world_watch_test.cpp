// The log names frames of the world pass that are taken but are not meant: another matrix in place of the
// view, bodies or a camera in another unit, a light from below. Right frames have no such message.
#include <cmath>
#include <cstring>
#include <optional>

#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

namespace {

using Matrix = std::array<float, 16>;

Matrix matrix_of(const View& view) {
  Matrix m;
  std::copy_n(view.matrix, 16, m.begin());
  return m;
}
constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// The matrix from view space to world space.
Matrix inverse_of(const View& view) {
  const float* m = view.matrix;
  const Vec3 eye = view.to_world({0, 0, 0});
  return {m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, eye.x, eye.y, eye.z, 1};
}

Matrix moved(Matrix m, float factor) {
  for (std::size_t i = 12; i < 15; ++i) m[i] *= factor;
  return m;
}

nook_capsule scaled(nook_capsule capsule, float factor) {
  for (float* end : {capsule.a, capsule.b})
    for (int i = 0; i < 3; ++i) end[i] *= factor;
  capsule.radius_a *= factor;
  capsule.radius_b *= factor;
  return capsule;
}

// Two balls on a floor before a wall, each with a capsule. Positions are in view space.
struct Body {
  Vec3 centre;
  float radius;
};
constexpr Body bodies[] = {{{-0.5f, -0.4f, -2.6f}, 0.45f}, {{0.6f, -0.5f, -2.2f}, 0.3f}};

std::vector<Surface> room(bool shows_bodies) {
  std::vector<Surface> surfaces{plane_through({0, -0.8f, 0}, {0, 1, 0}),
                                plane_through({0, 0, -4.5f}, {0, 0.1f, 1})};
  if (shows_bodies)
    for (const Body& body : bodies) surfaces.push_back(ball(body.centre, body.radius));
  return surfaces;
}

std::vector<nook_capsule> capsules_of(const View& view) {
  std::vector<nook_capsule> capsules;
  for (const Body& body : bodies)
    capsules.push_back(prop(view, body.centre, body.radius, body.centre, body.radius));
  return capsules;
}

// Green is 1 where the picture shows a body.
std::vector<float> mask_of(const Camera& camera, const Picture& picture) {
  const Picture empty = look(camera, room(false), picture.width, picture.height);
  std::vector<float> mask;
  for (std::size_t i = 0; i < picture.depth.size(); ++i)
    mask.insert(mask.end(), {1, picture.depth[i] < empty.depth[i] - 1e-4f ? 1.0f : 0.0f});
  return mask;
}

struct WatchFixture : NnaoFixture {
  explicit WatchFixture(platform::Context& made_in, std::int32_t debug = 1) : NnaoFixture(made_in) {
    nook_gl_desc desc;
    NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
    desc.get_proc = platform::Context::loader;
    desc.get_proc_user = &context;
    desc.debug = debug;
    NOOK_OK_OR_FAIL(nook_gl_create(host.handle, &desc, &watched));
  }
  ~WatchFixture() { nook_gl_destroy(&watched); }

  ScreenFrame screen(bool has_mask, bool shows_bodies = true) {
    const Picture picture = look(camera, room(shows_bodies), width, height);
    ScreenFrame frame = frame_desc(camera, width, height, depth_of(camera, picture), 0, 1);
    if (has_mask) {
      frame.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE;
      frame.gbuffer_ao_texture = textures.floats(GL_RG32F, 2, width, height,
                                                 mask_of(camera, look(camera, room(true), width, height)));
    }
    return frame;
  }

  // The lines that a new pass adds to the log.
  std::vector<std::string> lines_of(const DarkenedFrame& frame) {
    // More than the frames that must look wrong one after another (body_watch.cpp).
    const bool has_mask = frame.gbuffer_ao >= NOOK_GBUFFER_AO_REPLACE;
    return lines_of(frame, frame.light_degrees != 0 ? 130 : has_mask ? 20 : 70);
  }
  std::vector<std::string> lines_of(const DarkenedFrame& frame, int frames) {
    nook_world_desc desc = world_desc();
    desc.coloured = frame.light_degrees != 0;
    nook_world pass = nullptr;
    NOOK_OK_OR_FAIL(nook_world_create(watched, &desc, &pass));
    host.log.clear();
    for (int i = 0; i < frames; ++i) {
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      context.gl().Finish();  // so that answers are there
    }
    nook_world_destroy(&pass);
    return host.log;
  }
  std::vector<std::string> lines_of(const ScreenFrame& screen, const Matrix& view,
                                    const std::vector<nook_capsule>& capsules) {
    DarkenedFrame frame = framed(screen, view);
    frame.capsules = capsules.data();
    frame.capsule_count = std::uint32_t(capsules.size());
    return lines_of(frame);
  }
  static DarkenedFrame framed(const ScreenFrame& screen, const Matrix& view) {
    DarkenedFrame frame(screen);
    std::copy_n(view.begin(), 16, frame.view);
    return frame;
  }

  Camera camera = plain_camera(float(width) / height);
  nook_gl watched = nullptr;
};

void check_none(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) FAIL_CHECK(line);
}

void check_one(const std::vector<std::string>& lines, const char* part, const char* advice) {
  for (const std::string& line : lines) UNSCOPED_INFO(line);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find(part) != std::string::npos);
  CHECK(lines[0].find(advice) != std::string::npos);
}

}  // namespace

TEST_CASE("world watch: bodies where depth shows them are not logged") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context);
  const View view = turned_view();
  const std::vector<nook_capsule> capsules = capsules_of(view);
  for (const Camera& camera : cameras(float(width) / height))
    for (const bool has_mask : {false, true}) {
      INFO(camera.name << (has_mask ? ", with a mask" : ""));
      fixture.camera = camera;
      check_none(fixture.lines_of(fixture.screen(has_mask), matrix_of(view), capsules));
    }
  fixture.camera = plain_camera(float(width) / height);
  // Bodies that are drawn after the pass, but stand on the floor.
  check_none(fixture.lines_of(fixture.screen(false, false), matrix_of(view), capsules));
  // All bodies are outside of the view, and the mask shows other things, such as a weapon in the hand.
  const std::vector<nook_capsule> aside{prop(view, {9, 0, -3}, 0.5f, {9, 1, -3}, 0.5f)};
  for (const bool has_mask : {false, true})
    check_none(fixture.lines_of(fixture.screen(has_mask), matrix_of(view), aside));
  // A world that is given in view space.
  for (const bool has_mask : {false, true})
    check_none(fixture.lines_of(fixture.screen(has_mask), identity, capsules_of(View())));
}

TEST_CASE("world watch: the identity or the inverse in place of the view is logged once") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context);
  const View view = turned_view();
  const std::vector<nook_capsule> capsules = capsules_of(view);
  for (const bool has_mask : {false, true}) {
    INFO(has_mask);
    check_one(fixture.lines_of(fixture.screen(has_mask), identity, capsules), "bodies darken other places",
              "frame.view is the identity");
  }
  // Without a mask, only bodies that seem to float before surfaces tell that the view is wrong. Here the
  // inverse puts them beside the picture.
  if (context.is_es()) return;  // cannot count pixels
  check_one(fixture.lines_of(fixture.screen(true), inverse_of(view), capsules), "if frame.view were inverted",
            "set it to the inverse");
}

TEST_CASE("world watch: a view of another frame or of another scene is logged if bodies float",
          "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context);
  const View view = turned_view();
  Matrix other = matrix_of(view);
  other[13] += 1.1f;  // the bodies seem to be higher
  check_one(fixture.lines_of(fixture.screen(true), other, capsules_of(view)),
            "surfaces are seen where bodies", "the frame that drew the depth");
}

TEST_CASE("world watch: capsules, a view or depth in centimetres are logged once, with the unit that differs",
          "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  if (context.is_es()) return;  // cannot count pixels
  WatchFixture fixture(context);
  const View view = turned_view();
  std::vector<nook_capsule> metres = capsules_of(view), centimetres, hundredths;
  for (const nook_capsule& capsule : metres) {
    centimetres.push_back(scaled(capsule, 100));
    hundredths.push_back(scaled(capsule, 0.01f));
  }
  const ScreenFrame screen = fixture.screen(true);
  check_one(fixture.lines_of(screen, matrix_of(view), centimetres), "in a world 100 times smaller",
            "in the unit of frame.view");
  check_one(fixture.lines_of(screen, matrix_of(view), hundredths), "in a world 100 times larger",
            "in the unit of frame.view");
  check_one(fixture.lines_of(screen, moved(matrix_of(view), 100), metres),
            "the translation of frame.view were 100 times smaller", "give frame.view in the unit");
  check_one(fixture.lines_of(screen, moved(matrix_of(view), 0.01f), metres),
            "the translation of frame.view were 100 times larger", "give frame.view in the unit");
  check_one(fixture.lines_of(screen, moved(matrix_of(view), 100), centimetres),
            "if depth were 100 times larger", "give frame.projection");
}

namespace {

// One body of several capsules.
struct ScaledCrowd {
  ScaledCrowd(nook_context context, float scale, Vec3 at) {
    Numbers numbers(4);
    CharacterModel model = sample_model();
    add_world_casters(model, numbers);
    loaded = load_model(context, model);
    CrowdOptions options;
    options.instances = 1;
    options.occluders = options.nearest = options.links = false;
    options.scale = scale;
    options.offset = at;
    crowd.emplace(context, std::vector<nook_model>{loaded},
                  std::vector<std::uint32_t>{std::uint32_t(model.bone_count())}, options);
    crowd->pose(0);
  }
  ~ScaledCrowd() {
    crowd.reset();
    nook_model_destroy(&loaded);
  }
  void set_camera(Vec3 at) {
    const float position[3] = {at.x, at.y, at.z};
    NOOK_OK_OR_FAIL(nook_scene_set_camera(crowd->scene, position));
  }

  nook_model loaded = nullptr;
  std::optional<Crowd> crowd;
};

DarkenedFrame frame_of(const ScaledCrowd& crowd, const ScreenFrame& screen, const Matrix& view) {
  DarkenedFrame frame = WatchFixture::framed(screen, view);
  frame.scene = crowd.crowd->scene;
  return frame;
}

}  // namespace

TEST_CASE("world watch: bodies that are larger than everything in view are logged", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context);
  const ScreenFrame screen = fixture.screen(true);
  const ScaledCrowd centimetres(fixture.host.handle, 100, {0, 0, -300}),
      metres(fixture.host.handle, 1, {0, 0, -300});
  const View view = turned_view();
  check_one(fixture.lines_of(frame_of(centimetres, screen, matrix_of(view))),
            "nearer to the camera than a third of the smallest body's radius", "in one unit");
  check_none(fixture.lines_of(frame_of(metres, screen, matrix_of(view))));
}

TEST_CASE("world: without nook_gl_desc.debug, the camera of the scene tells what the view is") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context, 0);
  const ScreenFrame screen = fixture.screen(true);
  const View view = turned_view();
  ScaledCrowd crowd(fixture.host.handle, 1, {0, 0, -3});
  const auto lines = [&](const Matrix& given) { return fixture.lines_of(frame_of(crowd, screen, given), 3); };
  check_none(lines(identity));
  crowd.set_camera(view.to_world({0, 0, 0}));
  check_none(lines(matrix_of(view)));
  check_one(lines(identity), "it is the identity", "set frame.view");
  check_one(lines(inverse_of(view)), "it is the matrix from view space to world space", "set frame.view");
  check_one(lines(moved(matrix_of(view), 100)), "it has another unit", "in the unit of the poses");
  // The second camera of a split screen.
  Matrix other = matrix_of(view);
  other[12] += 2;
  check_none(lines(other));
  crowd.set_camera({0, 0, 0});
  check_none(lines(identity));
}

TEST_CASE("world: a mask that is left out is logged as information, once for each pass") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context, 0);
  ScaledCrowd crowd(fixture.host.handle, 1, {0, 0, -3});
  check_none(fixture.lines_of(frame_of(crowd, fixture.screen(true), identity), 3));
  check_one(fixture.lines_of(frame_of(crowd, fixture.screen(false), identity), 3), "without a mask",
            "draw a mask");
}

TEST_CASE("world: a cone in radians and a light from under the ground are logged, once") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context, 0);
  ScaledCrowd crowd(fixture.host.handle, 1, {0, 0, -3});
  const auto lines = [&](Vec3 axis, float degrees) {
    DarkenedFrame frame = frame_of(crowd, fixture.screen(true), identity);
    frame.light_axis[0] = axis.x;
    frame.light_axis[1] = axis.y;
    frame.light_axis[2] = axis.z;
    frame.light_degrees = degrees;
    return fixture.lines_of(frame, 3);
  };
  const Vec3 up{0, 0.8f, 0.6f}, down{0, -0.8f, 0.6f};
  for (const float degrees : {0.5f, 5.0f, 170.0f}) check_none(lines(up, degrees));
  // The sun, and a light of 10 degrees.
  for (const float degrees : {0.53f, 10.0f})
    check_one(lines(up, degrees / 57.29578f), "narrower than any sun", "multiply by 57.3");
  check_one(lines(down, 5), "points below the ground of all instances", "negate it");
  check_none(lines(down, 0));
  // A lamp at the height of the floor.
  check_none(lines({0, -0.02f, std::sqrt(1 - 0.0004f)}, 5));
}

TEST_CASE("world watch: a light that no surface faces is logged once", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  WatchFixture fixture(context);
  const View view = turned_view();
  const std::vector<nook_capsule> capsules = capsules_of(view);
  const auto lines = [&](Vec3 towards) {
    DarkenedFrame frame = WatchFixture::framed(fixture.screen(true), matrix_of(view));
    frame.capsules = capsules.data();
    frame.capsule_count = std::uint32_t(capsules.size());
    const Vec3 axis = view.turn_back(normalised(towards));
    frame.light_axis[0] = axis.x;
    frame.light_axis[1] = axis.y;
    frame.light_axis[2] = axis.z;
    frame.light_degrees = 5;
    return fixture.lines_of(frame);
  };
  check_none(lines({0, 1, 0}));
  check_none(lines({0.3f, 0.5f, -1}));  // against the light, with a floor
  // OpenGL ES cannot count pixels, and the edge of a ball may seem to face the light.
  if (context.is_es()) return;
  check_one(lines({-0.3f, -0.5f, -1}), "face away from desc.light_axis", "negate it");
}
