// The coloured world pass: the open shares of lobes and of a cone at every pixel, beside nook_world_sample.
#include <nook/nook_world.h>

#include <array>
#include <cmath>

#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

namespace {

nook_world_desc coloured_desc(int half = 0) {
  nook_world_desc desc = world_desc();
  desc.coloured = 1;
  desc.half_resolution = half;
  return desc;
}

std::vector<nook_lobe> window_light() {
  const auto lobe = [](Vec3 axis, float sharpness, Vec3 amplitude) {
    const Vec3 a = normalised(axis);
    return nook_lobe{{a.x, a.y, a.z}, sharpness, {amplitude.x, amplitude.y, amplitude.z}, 0};
  };
  std::vector<nook_lobe> lobes{lobe({1, 0.4f, 0.2f}, 3, {2, 1.6f, 1}),
                               lobe({-0.3f, 1, 0.5f}, 1, {0.2f, 0.4f, 0.9f}),
                               lobe({0, 1, 0}, 0, {0.1f, 0.1f, 0.12f})};
  // Lamps on a spiral, every third one bright: so many that all bands count.
  for (int i = 0; i < 21; ++i) {
    const float height = float(i) / 10 - 1, angle = 2.4f * float(i), bright = i % 3 == 0 ? 1.0f : 0.05f;
    const float radius = std::sqrt(1 - height * height);
    lobes.push_back(lobe({radius * std::cos(angle), height, radius * std::sin(angle)}, 9,
                         {bright, bright, 0.5f * bright}));
  }
  return lobes;
}

// Returns four numbers for each pixel, by nook_world_sample.
std::vector<float> sampled_light(const Picture& picture, const View& view, nook_scene scene,
                                 const std::vector<nook_capsule>& casters,
                                 const std::vector<nook_lobe>& lobes, Vec3 towards, float degrees) {
  std::vector<float> position, normal;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const std::size_t i = std::size_t(y) * picture.width + x;
      const float depth = std::isfinite(picture.depth[i]) ? picture.depth[i] : 1;
      const Vec3 p =
          view.to_world(nnao::view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, depth));
      const Vec3 n = view.turn_back(picture.normal[i]);
      position.insert(position.end(), {p.x, p.y, p.z});
      normal.insert(normal.end(), {n.x, n.y, n.z});
    }
  const std::size_t count = picture.depth.size();
  std::vector<float> ao(count), light(count), rgb(3 * count), all(4 * count);
  nook_world_sample_desc desc;
  NOOK_OK_OR_FAIL(nook_world_sample_desc_init(&desc));
  desc.positions = position.data();
  desc.normals = normal.data();
  desc.point_count = std::uint32_t(count);
  desc.capsules = casters.data();
  desc.capsule_count = std::uint32_t(casters.size());
  desc.lobes = lobes.data();
  desc.lobe_count = std::uint32_t(lobes.size());
  desc.directional_ao = rgb.data();
  const Vec3 axis = normalised(towards);
  desc.light_axis[0] = axis.x;
  desc.light_axis[1] = axis.y;
  desc.light_axis[2] = axis.z;
  desc.light_degrees = degrees;
  NOOK_OK_OR_FAIL(nook_world_sample(scene, &desc, ao.data(), light.data()));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 4; ++c)
      all[4 * i + c] = !std::isfinite(picture.depth[i]) ? 1 : c < 3 ? rgb[3 * i + c] : light[i];
  return all;
}

struct LightFixture : WorldFixture {
  explicit LightFixture(platform::Context& made_in) : WorldFixture(made_in) {}

  // Returns four numbers for each pixel.
  std::vector<float> drawn(const DarkenedFrame& frame) {
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
    nook_world_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
    return read_texture(context.gl(), info.texture, width, height, 4);
  }
};

void set_axis(DarkenedFrame& frame, Vec3 towards, float degrees) {
  const Vec3 axis = normalised(towards);
  frame.light_axis[0] = axis.x;
  frame.light_axis[1] = axis.y;
  frame.light_axis[2] = axis.z;
  frame.light_degrees = degrees;
}

std::vector<float> channel(const std::vector<float>& texels, std::size_t c) {
  std::vector<float> values;
  for (std::size_t i = c; i < texels.size(); i += 4) values.push_back(texels[i]);
  return values;
}

}  // namespace

TEST_CASE("world light: lobes and a cone darken as on the CPU, under every projection") {
  NOOK_NEED_CONTEXT(context);
  LightFixture fixture(context);
  nook_world pass = fixture.made(coloured_desc());
  REQUIRE(pass);
  const View view = turned_view();
  const std::vector<nook_capsule> casters = props(view);
  const std::vector<nook_lobe> lobes = window_light();
  const Vec3 towards{0.5f, 1, 0.3f};
  for (const Camera& camera : cameras(float(width) / height)) {
    INFO(camera.name);
    const Picture picture = look(camera, still_life(), width, height);
    const ScreenFrame screen =
        frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
    for (const float degrees : {6.0f, 50.0f}) {
      DarkenedFrame frame = world_frame(screen, view);
      frame.capsules = casters.data();
      frame.capsule_count = std::uint32_t(casters.size());
      frame.lobes = lobes.data();
      frame.lobe_count = std::uint32_t(lobes.size());
      set_axis(frame, towards, degrees);
      const std::vector<float> found = fixture.drawn(frame),
                               wanted =
                                   sampled_light(picture, view, nullptr, casters, lobes, towards, degrees);
      for (std::size_t c = 0; c < 4; ++c) {
        const std::vector<float> want = channel(wanted, c);
        const Difference off = difference(channel(found, c), want, c < 3 ? bound : 2 * bound);
        INFO("channel " << c << ": largest " << off.largest << ", mean " << off.mean << ", beyond "
                        << off.beyond << ", darkest " << darkest(want));
        // As for AO; a cone has edges, where depth of few digits moves a shadow.
        CHECK(off.beyond <= (c < 3 ? 0.01f : 0.02f));
        CHECK(off.mean < 0.5f * bound);
        CHECK(darkest(want) < 0.7f);
      }
    }
  }
}

TEST_CASE("world light: without light the coloured pass has AO in three channels, and 1") {
  NOOK_NEED_CONTEXT(context);
  LightFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const View view;
  const std::vector<nook_capsule> casters = props(view);
  for (const int half : {0, 1}) {
    DarkenedFrame frame = world_frame(screen, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    nook_world_destroy(&fixture.pass);
    fixture.made(coloured_desc(half));
    const std::vector<float> coloured = fixture.drawn(frame);
    nook_world_destroy(&fixture.pass);
    nook_world_desc plain = coloured_desc(half);
    plain.coloured = 0;
    fixture.made(plain);
    NOOK_OK_OR_FAIL(nook_world_render(fixture.pass, &frame, &frame));
    const std::vector<float> ao = fixture.own();
    for (std::size_t i = 0; i < ao.size(); ++i) {
      // A step of 8 bits, since 1 - (1 - AO) rounds.
      for (std::size_t c = 0; c < 3; ++c) REQUIRE(std::abs(coloured[4 * i + c] - ao[i]) < 1.1f / 255);
      REQUIRE(coloured[4 * i + 3] == 1);
    }
  }
}

TEST_CASE("world light: half resolution comes close, sky and masked pixels are open") {
  NOOK_NEED_CONTEXT(context);
  LightFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  std::vector<float> mask(std::size_t(2 * width * height), 1.0f);
  for (int i = 0; i < width * height; ++i) mask[std::size_t(2 * i + 1)] = i % width < 20 ? 1 : 0;
  screen.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE;
  screen.gbuffer_ao_texture = fixture.textures.floats(GL_RG32F, 2, width, height, mask);
  const View view;
  const std::vector<nook_capsule> casters = props(view);
  const std::vector<nook_lobe> lobes = window_light();
  std::array<std::vector<float>, 2> results;
  for (const int half : {0, 1}) {
    nook_world_destroy(&fixture.pass);
    fixture.made(coloured_desc(half));
    DarkenedFrame frame = world_frame(screen, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    frame.lobes = lobes.data();
    frame.lobe_count = std::uint32_t(lobes.size());
    set_axis(frame, {0.5f, 1, 0.3f}, 30);
    results[std::size_t(half)] = fixture.drawn(frame);
  }
  for (std::size_t i = 0; i < picture.depth.size(); ++i)
    if (!std::isfinite(picture.depth[i]) || i % width < 20)
      for (std::size_t c = 0; c < 4; ++c)
        for (const std::vector<float>& result : results) REQUIRE(result[4 * i + c] == 1);
  // Edges of the balls alone differ.
  CHECK(difference(results[1], results[0], 0.05f).beyond < 0.05f);
}

TEST_CASE("world light: bad light is refused with the field's name") {
  NOOK_NEED_CONTEXT(context);
  LightFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const std::vector<nook_lobe> lobes = window_light();
  const auto refused = [&](const char* text, auto&& change) {
    DarkenedFrame frame = world_frame(screen, View());
    frame.lobes = lobes.data();
    frame.lobe_count = std::uint32_t(lobes.size());
    change(frame);
    CHECK(nook_world_render(fixture.pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(text) != std::string::npos);
  };
  fixture.made();
  refused("desc.lobes needs a coloured pass", [](auto&) {});
  nook_world_destroy(&fixture.pass);
  fixture.made(coloured_desc());
  refused("desc.lobes is NULL", [](auto& f) { f.lobes = nullptr; });
  refused("lobe_count", [](auto& f) { f.lobe_count = NOOK_PROBE_MAX_FUNCTIONS + 1; });
  nook_lobe bad = lobes[0];
  bad.sharpness = NAN;
  refused("sharpness of lobe 0", [&](auto& f) {
    f.lobes = &bad;
    f.lobe_count = 1;
  });
  refused("desc.light_axis", [](auto& f) { f.light_degrees = 10; });
  refused("desc.light_degrees", [](auto& f) { set_axis(f, {0, 1, 0}, 179); });
  refused("desc.light_degrees", [](auto& f) { set_axis(f, {0, 1, 0}, NAN); });
  refused("desc.light_reach", [](auto& f) {
    set_axis(f, {0, 1, 0}, 10);
    f.light_reach = -1;
  });
  nook_world_desc odd = coloured_desc();
  odd.coloured = 2;
  nook_world none = nullptr;
  CHECK(nook_world_create(fixture.gl, &odd, &none) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()).find("desc.coloured") != std::string::npos);
}
