// Textures, alone and on the surfaces of a lit scene, against closed forms.
#include "bakers/raytrace/texture.h"

#include <cmath>
#include <numbers>

#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/raytrace/sphere_soup.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Two texels across, one down: black and white, opaque and half open.
Texture black_and_white() {
  return Texture(2, 1, {0, 0, 0, 255, 255, 255, 255, 127});
}

TextureUse used(TextureWrap wrap = TextureWrap::repeat, bool nearest = false) {
  TextureUse use;
  use.image = 0;
  use.wrap_u = use.wrap_v = wrap;
  use.nearest = nearest;
  return use;
}

// A floor of 2 x 2 metres round the origin; u along x and v along z, once over it.
LitTriangles textured_floor(const Surface& surface, Texture texture) {
  LitTriangles lit{{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}}, {surface}};
  lit.triangle_surface = {0, 0};
  lit.uv = {{TexturePoint{0, 0}}, {TexturePoint{1, 0}}, {TexturePoint{1, 1}}, {TexturePoint{0, 1}}};
  lit.texture.push_back(std::move(texture));
  return lit;
}

// 8 x 8 texels of one colour or the other by turns, from the upper left.
Texture checkerboard(std::array<std::uint8_t, 4> first, std::array<std::uint8_t, 4> second) {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < 64; ++i) {
    const auto& colour = (i + i / 8) % 2 ? second : first;
    rgba.insert(rgba.end(), colour.begin(), colour.end());
  }
  return Texture(8, 8, std::move(rgba));
}

Vec3 mean_radiance(const LitScene& scene, Vec3 origin, Vec3 direction, int paths) {
  Random random(3);
  Vec3 sum;
  for (int i = 0; i < paths; ++i) sum += trace_radiance(scene, origin, direction, {}, random);
  return sum * (1 / float(paths));
}

Environment sky(float radiance) {
  return Environment(1, 1, {radiance, radiance, radiance});
}

}  // namespace

TEST_CASE("texels are sRGB, and mixed in linear light") {
  const Texture texture = black_and_white();
  CHECK(texture.at(used(), {0.25f, 0.5f}).rgb == Vec3{0, 0, 0});
  CHECK(texture.at(used(), {0.75f, 0.5f}).rgb == Vec3{1, 1, 1});
  const TextureColour middle = texture.at(used(), {0.5f, 0.5f});
  CHECK(std::abs(middle.rgb.x - 0.5f) < 1e-5f);
  CHECK(std::abs(middle.alpha - (1 + 127.0f / 255) / 2) < 1e-5f);
  const Texture grey(1, 1, {128, 10, 255, 255});
  // IEC 61966-2-1: 128 is 21.586 % of white, 10 is 0.3035 %.
  CHECK(std::abs(grey.at(used(), {0.3f, 0.9f}).rgb.x - 0.21586f) < 1e-5f);
  CHECK(std::abs(grey.at(used(), {0.3f, 0.9f}).rgb.y - 0.003035f) < 1e-6f);
}

TEST_CASE("textures repeat, mirror or end at their edge, near and far") {
  const Texture texture = black_and_white();
  const auto at = [&](TextureWrap wrap, float u) { return texture.at(used(wrap), {u, 0.5f}).rgb.x; };
  CHECK(std::abs(at(TextureWrap::repeat, 0) - 0.5f) < 1e-5f);  // between the last texel and the first
  CHECK(at(TextureWrap::clamped, 0) == 0);
  CHECK(at(TextureWrap::mirrored, 0) == 0);
  for (const float turn : {1.0f, -3.0f, 1001.0f}) {
    CHECK(std::abs(at(TextureWrap::repeat, turn + 0.75f) - 1) < 1e-3f);
    CHECK(std::abs(at(TextureWrap::mirrored, turn + 0.75f)) < 1e-3f);  // an odd image runs backwards
    CHECK(at(TextureWrap::clamped, turn + 0.75f) == (turn > 0 ? 1.0f : 0.0f));
  }
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirrored, TextureWrap::clamped})
    for (const float u : {1e30f, -1e30f, 3e38f, 1e-30f}) CHECK(std::isfinite(at(wrap, u)));
  CHECK(texture.at(used(TextureWrap::repeat, true), {0.49f, 0.5f}).rgb.x == 0);
  CHECK(texture.at(used(TextureWrap::repeat, true), {0.51f, 0.5f}).rgb.x == 1);
  TextureUse moved = used();
  moved.transform = {0, 1, 0.5f, 1, 0, 0};
  CHECK(texture.at(moved, {0.5f, 0.25f}).rgb.x == 1);
  CHECK_THROWS_AS(Texture(2, 2, {1, 2, 3}), Failure);
}

TEST_CASE("a white checkerboard under a sky of 1 sends back what its texels say") {
  Surface floor;
  floor.base_colour = {0.5f, 1, 0.25f};
  floor.base_colour_texture = used();
  const LitScene scene(textured_floor(floor, checkerboard({255, 255, 255, 255}, {128, 0, 255, 255})), sky(1));
  for (int i = 0; i < 64; ++i) {
    const float x = -0.875f + 0.25f * float(i % 8), z = -0.875f + 0.25f * float(i / 8);
    const Vec3 seen = mean_radiance(scene, {x, 1, z}, {0, -1, 0}, 256);
    const bool second = (i + i / 8) % 2;
    const Vec3 expected = second ? Vec3{0.5f * 0.21586f, 0, 0.25f} : floor.base_colour;
    INFO("texel " << i);
    // A third of the mean a path (path_tracer_test): 2 % of 256.
    CHECK(std::abs(seen.x - expected.x) < 0.08f * expected.x);
    CHECK(std::abs(seen.y - expected.y) <= 0.08f * expected.y);
    CHECK(std::abs(seen.z - expected.z) < 0.08f * expected.z);
  }
}

TEST_CASE("a floor that shines through a checkerboard lights what is close above it by its mean") {
  Surface lamp;
  lamp.base_colour = {0, 0, 0};
  lamp.emission = {2, 4, 6};
  lamp.emission_texture = used();
  const LitScene scene(textured_floor(lamp, checkerboard({255, 255, 255, 255}, {0, 0, 0, 255})), sky(0));
  CHECK(mean_radiance(scene, {-0.875f, 1, -0.875f}, {0, -1, 0}, 1) == Vec3{2, 4, 6});
  CHECK(mean_radiance(scene, {-0.625f, 1, -0.875f}, {0, -1, 0}, 1) == Vec3{});
  const Vec3 position{0, 1, 0}, down{0, -1, 0};
  IrradianceSettings settings;
  settings.rays = 16384;
  const Vec3 e = trace_irradiance(scene, {{&position, 1}, {&down, 1}}, settings)[0];
  // J. Lambert's factor of a square of side 2 seen from the middle of its axis at height 1, four corners of
  // 1 x 1: 4 / (2 pi) 2 (1 / sqrt 2) atan(1 / sqrt 2). The pattern is balanced about the point.
  const float share =
      4 / (2 * pi) * std::numbers::sqrt2_v<float> * std::atan(1 / std::numbers::sqrt2_v<float>);
  CHECK(std::abs(e.x / (pi * share * 2 * 0.5f) - 1) <
        0.03f);  // half of the paths that hit: standard error 1 %
  CHECK(std::abs(e.y / (2 * e.x) - 1) < 1e-4f);
}

TEST_CASE("a furnace whose walls are a texture") {
  Surface wall;
  wall.base_colour = {1, 0.5f, 1};
  wall.base_colour_texture = used();
  wall.emission = {1, 1, 1};
  LitTriangles room{sphere_soup({0, 0, 0}, 1, 24), {wall}};
  room.triangle_surface.assign(room.soup.triangle.size(), 0);
  room.uv.assign(room.soup.position.size(), {});
  room.texture.push_back(Texture(1, 1, {188, 188, 0, 255}));  // 0.5029 in linear light
  const LitScene scene(std::move(room), sky(9));
  IrradianceSettings settings;
  settings.rays = 4096;
  settings.path.origin_offset = 1e-3f;
  const Vec3 position{0.1f, 0.2f, -0.3f}, up{0, 0, 1};
  const Vec3 e = trace_irradiance(scene, {{&position, 1}, {&up, 1}}, settings)[0];
  CHECK(std::abs(e.x / (pi / (1 - 0.5029f)) - 1) < 0.03f);  // roulette's scatter: standard error 1 %
  CHECK(std::abs(e.y / (pi / (1 - 0.25145f)) - 1) < 0.02f);
  CHECK(std::abs(e.z / pi - 1) < 1e-4f);
}

TEST_CASE("rays pass through the holes of an alpha mask") {
  Surface fence;
  fence.base_colour_texture = used(TextureWrap::repeat, true);
  fence.alpha_cutoff = 0.5f;
  const auto scene_of = [&](float alpha) {
    fence.alpha = alpha;
    return std::make_unique<LitScene>(
        textured_floor(fence, checkerboard({255, 255, 255, 255}, {255, 255, 255, 100})), sky(1));
  };
  const auto solid = scene_of(1), none = scene_of(0.4f);
  CHECK(solid->occluded({-0.875f, 1, -0.875f}, {0, -1, 0}));
  CHECK_FALSE(solid->occluded({-0.625f, 1, -0.875f}, {0, -1, 0}));
  CHECK(solid->nearest({-0.875f, 1, -0.875f}, {0, -1, 0}).distance == 1);
  CHECK(std::isinf(solid->nearest({-0.625f, 1, -0.875f}, {0, -1, 0}).distance));
  CHECK(std::isinf(none->nearest({-0.875f, 1, -0.875f}, {0, -1, 0}).distance));
  // Under the fence half of the light arrives that an open sky would send through it.
  const Vec3 position{0, -1, 0}, up{0, 1, 0};
  IrradianceSettings settings;
  settings.rays = 16384;
  settings.path.max_bounces = 0;
  const Vec3 e = trace_irradiance(*solid, {{&position, 1}, {&up, 1}}, settings)[0];
  const float share =
      4 / (2 * pi) * std::numbers::sqrt2_v<float> * std::atan(1 / std::numbers::sqrt2_v<float>);
  CHECK(std::abs(e.x / (pi * (1 - share / 2)) - 1) < 0.02f);
}
