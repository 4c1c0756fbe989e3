// The world pass: the AO of nook_world_sample at every pixel, reach, levels, half resolution, masks and
// composition.
#include <nook/nook_world.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>

#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

TEST_CASE("world: a pass describes its textures and the text for hosts' shaders") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_world_describe(fixture.made(), &info));
  CHECK(context.gl().IsTexture(info.texture));
  CHECK(context.gl().IsTexture(info.caster_texture));
  CHECK(info.caster_count == 0);
  CHECK(info.texture_bytes > std::uint64_t(width * height));
  CHECK(std::strstr(info.glsl, "float nook_world_open(vec3 point, vec3 normal)") != nullptr);
}

TEST_CASE("world: a sphere and a capsule darken as on the CPU, under every projection") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  const View view = turned_view();
  const std::vector<nook_capsule> casters = props(view);
  for (const Camera& camera : cameras(float(width) / height)) {
    INFO(camera.name);
    const Picture picture = look(camera, still_life(), width, height);
    const ScreenFrame screen =
        frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
    DarkenedFrame frame = world_frame(screen, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
    const std::vector<float> wanted = sampled(picture, view, nullptr, casters);
    const Difference found = difference(fixture.own(), wanted, bound);
    INFO("largest " << found.largest << ", mean " << found.mean << ", darkest " << darkest(wanted));
    // Depth of a camera whose range is wide has few digits far away; a pixel on a caster's surface may flip.
    CHECK(found.beyond <= 0.01f);
    CHECK(found.mean < 0.5f * bound);
    CHECK(darkest(wanted) < 0.7f);
  }
}

TEST_CASE("world: normals from depth come close to the host's normals") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const View view = turned_view();
  const std::vector<nook_capsule> casters = props(view);
  const ScreenFrame screen = frame_desc(camera, width, height, fixture.depth_of(camera, picture), 0, 1);
  DarkenedFrame frame = world_frame(screen, view);
  frame.capsules = casters.data();
  frame.capsule_count = std::uint32_t(casters.size());
  NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
  // Edges of the balls alone differ.
  CHECK(difference(fixture.own(), sampled(picture, view, nullptr, casters), 0.05f).beyond < 0.03f);
}

TEST_CASE("world: the bodies of a scene darken as on the CPU, and outgrow the table") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  Numbers numbers(4);
  CharacterModel model = sample_model();
  add_world_casters(model, numbers);
  nook_model loaded = load_model(fixture.host.handle, model);
  {
    CrowdOptions options;
    options.instances = 7;
    options.offset = {0, -0.3f, -3};
    options.occluders = true;
    Crowd crowd(fixture.host.handle, {loaded}, {std::uint32_t(model.bone_count())}, options);
    for (const std::uint32_t frame_number : {0u, 1u}) {
      crowd.pose(frame_number);
      const View view;
      const Camera camera = plain_camera(float(width) / height);
      const Picture picture = look(camera, still_life(), width, height);
      const ScreenFrame screen = frame_desc(camera, width, height, fixture.depth_of(camera, picture),
                                            fixture.normals_of(picture), 1);
      DarkenedFrame frame = world_frame(screen, view);
      frame.scene = crowd.scene;
      frame.cutoff_error = frame.level_error = 0;
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      const std::vector<float> wanted = sampled(picture, view, crowd.scene, {});
      const Difference found = difference(fixture.own(), wanted, bound);
      INFO("largest " << found.largest << ", mean " << found.mean << ", darkest " << darkest(wanted));
      CHECK(found.beyond <= 0.01f);
      CHECK(darkest(wanted) < 0.7f);
    }
  }
  nook_model_destroy(&loaded);
}

TEST_CASE("world: sky and a frame without casters are exactly open") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  for (const float value : fixture.own()) REQUIRE(value == 1);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const View view;
  DarkenedFrame frame = world_frame(screen, view);
  NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
  for (const float value : fixture.own()) REQUIRE(value == 1);
  const nook_capsule everywhere = prop(view, {0, 0, -3}, 2.5f, {0, 0, -4}, 2.5f);
  frame.capsules = &everywhere;
  frame.capsule_count = 1;
  NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
  const std::vector<float> ao = fixture.own();
  int open_sky = 0;
  for (std::size_t i = 0; i < ao.size(); ++i)
    if (!std::isfinite(picture.depth[i])) {
      REQUIRE(ao[i] == 1);
      ++open_sky;
    }
  CHECK(open_sky > 0);
  CHECK(darkest(ao) < 0.2f);
}

TEST_CASE("world: a mask keeps its pixels, and casters multiply") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  std::vector<float> mask(std::size_t(2 * width * height), 1.0f);
  for (int i = 0; i < width * height; ++i) mask[std::size_t(2 * i + 1)] = i % width < width / 2 ? 1 : 0;
  ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const View view;
  const std::vector<nook_capsule> casters = props(view);
  const auto drawn = [&](std::size_t first, std::size_t count) {
    DarkenedFrame frame = world_frame(screen, view);
    frame.capsules = casters.data() + first;
    frame.capsule_count = std::uint32_t(count);
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
    return fixture.own();
  };
  const std::vector<float> all = drawn(0, 3), one = drawn(0, 1), two = drawn(1, 1), three = drawn(2, 1);
  float worst = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    worst = std::max(worst, std::abs(all[i] - one[i] * two[i] * three[i]));
  // Four roundings to 8 bits.
  CHECK(worst < 2.5f / 255);
  screen.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE;
  screen.gbuffer_ao_texture = fixture.textures.floats(GL_RG32F, 2, width, height, mask);
  const std::vector<float> masked = drawn(0, 3);
  for (std::size_t i = 0; i < masked.size(); ++i)
    REQUIRE(masked[i] == (int(i) % width < width / 2 ? 1.0f : all[i]));
}

TEST_CASE("world: nothing is darkened beyond the stated reach, and by no more than the cut-off within") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  Numbers numbers(4);
  CharacterModel model = sample_model();
  add_world_casters(model, numbers);
  nook_model loaded = load_model(fixture.host.handle, model);
  {
    CrowdOptions options;
    options.instances = 1;
    options.occluders = false;
    options.offset = {0, 0, -2.2f};
    Crowd crowd(fixture.host.handle, {loaded}, {std::uint32_t(model.bone_count())}, options);
    crowd.pose(0);
    const Camera camera = plain_camera(float(width) / height);
    const Picture picture = look(camera, still_life(), width, height);
    const ScreenFrame screen =
        frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
    const auto drawn = [&](float cutoff) {
      DarkenedFrame frame = world_frame(screen, View());
      frame.scene = crowd.scene;
      frame.cutoff_error = cutoff;
      frame.level_error = 0;
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      return fixture.own();
    };
    const std::vector<float> all = drawn(0), cut = drawn(0.05f);
    int changed = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      // A step of 8 bits for rounding.
      REQUIRE((cut[i] == all[i] || (cut[i] == 1 && all[i] > 0.95f - 1.0f / 255)));
      changed += cut[i] != all[i];
    }
    CHECK(changed > 0);
  }
  nook_model_destroy(&loaded);
}

namespace {

// A crowd of bodies round the still life, which a camera looks at.
struct CrowdFixture : WorldFixture {
  explicit CrowdFixture(platform::Context& made_in) : WorldFixture(made_in) {
    Numbers numbers(4);
    CharacterModel model = sample_model();
    add_world_casters(model, numbers);
    loaded = load_model(host.handle, model);
    CrowdOptions options;
    options.instances = 7;
    options.offset = {0, -0.3f, -3};
    options.occluders = true;
    crowd.emplace(host.handle, std::vector<nook_model>{loaded},
                  std::vector<std::uint32_t>{std::uint32_t(model.bone_count())}, options);
    crowd->pose(0);
  }
  ~CrowdFixture() {
    crowd.reset();
    nook_model_destroy(&loaded);
  }

  ScreenFrame screen() {
    return frame_desc(camera, width, height, depth_of(camera, picture), normals_of(picture), 0.5f);
  }
  // level_error is 0.
  DarkenedFrame frame(const ScreenFrame& of) const {
    DarkenedFrame frame = world_frame(of, View());
    frame.scene = crowd->scene;
    frame.cutoff_error = frame.level_error = 0;
    return frame;
  }
  std::vector<float> drawn(const DarkenedFrame& frame) {
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
    return own();
  }

  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  nook_model loaded = nullptr;
  std::optional<Crowd> crowd;
};

double mean_square(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
  return sum / double(a.size());
}

}  // namespace

TEST_CASE("world: levels stay within their error, with fewer casters at a pixel", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  CrowdFixture fixture(context);
  fixture.made();
  const ScreenFrame screen = fixture.screen();
  DarkenedFrame frame = fixture.frame(screen);
  const std::vector<float> all = fixture.drawn(frame);
  const auto mean_casters = [&] {
    frame.debug.show = NOOK_WORLD_VIEW_CASTERS;
    const std::vector<float> counts = fixture.drawn(frame);
    frame.debug.show = NOOK_WORLD_VIEW_AO;
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (std::isfinite(fixture.picture.depth[i])) sum += 255 * double(counts[i]);
    return sum;
  };
  const double without_levels = mean_casters();
  for (const float error : {1.0f / 256, 1.0f / 32}) {
    frame.level_error = error;
    // The rms belongs to one body; seven of them add as if independent. A step of 8 bits besides.
    CHECK(std::sqrt(mean_square(fixture.drawn(frame), all)) < std::sqrt(7.0) * double(error) + 1.0 / 255);
  }
  CHECK(mean_casters() < without_levels);
}

TEST_CASE("world: a crowd that moves away pops by a few level errors at most", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  CrowdFixture fixture(context);
  fixture.made();
  const ScreenFrame screen = fixture.screen();
  DarkenedFrame frame = fixture.frame(screen);
  constexpr float error = 1.0f / 64;
  std::vector<float> before;
  float pop = 0;
  for (int step = 0; step < 14; ++step) {
    // Casters move, and the surfaces that they darken stay.
    frame.view[14] = -0.3f * float(step);
    frame.level_error = 0;
    const std::vector<float> all = fixture.drawn(frame);
    frame.level_error = error;
    std::vector<float> off = fixture.drawn(frame);
    for (std::size_t i = 0; i < off.size(); ++i) {
      off[i] -= all[i];
      if (step > 0) pop = std::max(pop, std::abs(off[i] - before[i]));
    }
    before = off;
  }
  INFO("largest pop " << pop);
  // The error is an rms over points and normals; the largest of some 1e5 changes is several times as much.
  CHECK(pop < 8 * error);
  CHECK(pop > 0);
}

TEST_CASE("world: half resolution comes close to full resolution") {
  NOOK_NEED_CONTEXT(context);
  CrowdFixture fixture(context);
  const ScreenFrame screen = fixture.screen();
  const DarkenedFrame frame = fixture.frame(screen);
  fixture.made();
  const std::vector<float> full = fixture.drawn(frame);
  nook_world_destroy(&fixture.pass);
  nook_world_desc desc = world_desc();
  desc.half_resolution = 1;
  fixture.made(desc);
  const std::vector<float> half = fixture.drawn(frame);
  // Balls of a few pixels have edges all over; elsewhere AO is smooth.
  CHECK(difference(half, full, 0.05f).beyond < 0.05f);
  CHECK(std::sqrt(mean_square(half, full)) < 0.03);
  for (std::size_t i = 0; i < half.size(); ++i)
    if (!std::isfinite(fixture.picture.depth[i])) REQUIRE(half[i] == 1);
}

TEST_CASE("world: half resolution with levels stays near every caster, also where near and far bodies blend",
          "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  CrowdFixture fixture(context);
  nook_world_desc desc = world_desc();
  desc.half_resolution = 1;
  fixture.made(desc);
  const ScreenFrame screen = fixture.screen();
  DarkenedFrame frame = fixture.frame(screen);
  std::vector<float> before;
  for (int step = 0; step < 8; ++step) {
    frame.view[14] = -0.4f * float(step);
    frame.level_error = 0;
    const std::vector<float> all = fixture.drawn(frame);
    frame.level_error = 1.0f / 64;
    const std::vector<float> levels = fixture.drawn(frame);
    // Seven bodies of that rms; a body that blends has up to three times its error; two steps of 8 bits.
    CHECK(std::sqrt(mean_square(levels, all)) < 3 * std::sqrt(7.0) / 64 + 2.0 / 255);
    for (std::size_t i = 0; i < levels.size(); ++i)
      if (!std::isfinite(fixture.picture.depth[i])) REQUIRE(levels[i] == 1);
    // The crowd moves on, and what it darkens changes little by little.
    if (step > 0) CHECK(difference(levels, before, 0.25f).beyond < 0.02f);
    before = levels;
  }
}

namespace {

struct GroupPictures {
  std::vector<float> open, tests, far_tests;  // of a crowd in two places, one after the other
};

GroupPictures drawn_by(CrowdFixture& fixture, nook_gl gl, const nook_world_desc& desc, DarkenedFrame frame) {
  NOOK_OK_OR_FAIL(nook_world_create(gl, &desc, &fixture.pass));
  GroupPictures pictures;
  for (const float away : {0.0f, 1.2f}) {
    frame.view[14] = -away;
    const auto add = [&](nook_world_view view, std::vector<float>& all) {
      frame.debug.show = view;
      const std::vector<float> one = fixture.drawn(frame);
      all.insert(all.end(), one.begin(), one.end());
    };
    add(NOOK_WORLD_VIEW_AO, pictures.open);
    add(NOOK_WORLD_VIEW_TESTS, pictures.tests);
    add(NOOK_WORLD_VIEW_FAR_TESTS, pictures.far_tests);
  }
  nook_world_destroy(&fixture.pass);
  return pictures;
}

double sum_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("world: groups of threads leave as much open as draws, with fewer tests") {
  NOOK_NEED_CONTEXT(context);
  if (!computes(tiers_of(context).front())) return;
  CrowdFixture fixture(context);
  nook_gl draws = create_gl(fixture.host.handle, platform::Context::loader, &context,
                            is_es(context.gl()) ? NOOK_GL_TIER_ES30 : NOOK_GL_TIER_33);
  ScreenFrame screen = fixture.screen();
  std::vector<float> mask(std::size_t(2 * width * height), 1.0f);
  for (int i = 0; i < width * height; ++i) mask[std::size_t(2 * i + 1)] = i % width < width / 3 ? 1 : 0;
  screen.gbuffer_ao_texture = fixture.textures.floats(GL_RG32F, 2, width, height, mask);
  // A pass for higher images has groups of 64 pixels for far bodies in place of 16.
  for (const bool high : {false, true}) {
    nook_world_desc desc = world_desc(width, high ? 1000 : height);
    desc.half_resolution = 1;
    desc.coloured = high;
    screen.gbuffer_ao = high ? NOOK_GBUFFER_AO_REPLACE : NOOK_GBUFFER_AO_NONE;
    screen.normal_texture = high ? 0 : fixture.normals_of(fixture.picture);
    DarkenedFrame frame = fixture.frame(screen);
    frame.level_error = 1.0f / 64;
    frame.cutoff_error = 1.0f / 256;
    const GroupPictures groups = drawn_by(fixture, fixture.gl, desc, frame),
                        draw = drawn_by(fixture, draws, desc, frame);
    const Difference found = difference(groups.open, draw.open, 0.5f / 255);
    INFO("high " << high << ", largest " << found.largest);
    // A step of 8 bits where a sum comes to lie on the other side of a half.
    CHECK(found.largest < 1.5f / 255);
    CHECK(found.beyond < 0.02f);
    CHECK(sum_of(groups.tests) <= sum_of(draw.tests));
    CHECK(sum_of(groups.far_tests) <= sum_of(draw.far_tests));
  }
  nook_gl_destroy(&draws);
}

TEST_CASE("world: AO of another kind is composed by product and by minimum") {
  NOOK_NEED_CONTEXT(context);
  CrowdFixture fixture(context);
  for (const int half : {0, 1}) {
    nook_world_destroy(&fixture.pass);
    nook_world_desc desc = world_desc();
    desc.half_resolution = half;
    fixture.made(desc);
    const ScreenFrame screen = fixture.screen();
    DarkenedFrame frame = fixture.frame(screen);
    const std::vector<float> alone = fixture.drawn(frame);
    std::vector<float> other(std::size_t(width) * height);
    for (std::size_t i = 0; i < other.size(); ++i) other[i] = float(i % 17) / 16;
    frame.ao_texture = fixture.textures.floats(GL_R32F, 1, width, height, other);
    for (const nook_world_combine composition : {NOOK_WORLD_COMBINE_MULTIPLY, NOOK_WORLD_COMBINE_MIN}) {
      frame.combine = composition;
      const std::vector<float> found = fixture.drawn(frame);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const float wanted =
            composition == NOOK_WORLD_COMBINE_MULTIPLY ? alone[i] * other[i] : std::min(alone[i], other[i]);
        // Two roundings to 8 bits.
        REQUIRE(std::abs(found[i] - wanted) < 1.1f / 255);
      }
    }
  }
}

TEST_CASE("world: the screen pass leaves surfaces apart out of its occluders") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  Picture picture = look(camera, still_life(), width, height);
  // The nearer half of the surfaces stands for characters.
  std::vector<float> depths;
  for (const float d : picture.depth)
    if (std::isfinite(d)) depths.push_back(d);
  std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(depths.size() / 2), depths.end());
  const float middle = depths[depths.size() / 2];
  std::vector<float> layer(std::size_t(2 * width * height), 0.0f);
  Picture without = picture;
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    layer[2 * i] = 0.25f;
    if (!(picture.depth[i] < middle)) continue;
    layer[2 * i + 1] = 1;
    without.depth[i] = INFINITY;
  }
  for (const int half : {0, 1}) {
    nook_nnao pass = fixture.pass_of(9, half, 1, nullptr);
    const auto drawn = [&](const Picture& of, nook_gbuffer_ao mode) {
      ScreenFrame frame =
          frame_desc(camera, width, height, fixture.depth_of(camera, of), fixture.normals_of(picture), 0.6f);
      frame.gbuffer_ao = mode;
      frame.gbuffer_ao_texture = fixture.textures.floats(GL_RG32F, 2, width, height, layer);
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      nook_nnao_info info{};
      info.struct_size = sizeof info;
      NOOK_OK_OR_FAIL(nook_nnao_describe(pass, &info));
      return read_texture(context.gl(), info.texture, width, height);
    };
    const std::vector<float> apart = drawn(picture, NOOK_GBUFFER_AO_EXCLUDE),
                             removed = drawn(without, NOOK_GBUFFER_AO_REPLACE),
                             present = drawn(picture, NOOK_GBUFFER_AO_REPLACE);
    int changed = 0;
    for (std::size_t i = 0; i < apart.size(); ++i) {
      REQUIRE(apart[i] == removed[i]);
      changed += apart[i] != present[i];
    }
    CHECK(changed > 50);
  }
}
