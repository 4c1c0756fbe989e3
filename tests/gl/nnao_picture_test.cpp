// The visible result: planes, sky, borders, edges, blur, half resolution, normals rebuilt from depth.
#include <algorithm>
#include <limits>

#include "sdk/src/nnao/filter.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr float step = 1.0f / 255;  // of the 8 bits that AO is kept in
constexpr int width = 96, height = 54;

struct Drawing {
  int half = 0, blur = 1, taps = 16;
  nook_nnao_view view = NOOK_NNAO_VIEW_AO;
  float radius = 0.5f;
  bool normals = false;  // given
};

// network NULL: the embedded one.
std::vector<float> draw(NnaoFixture& fixture, const Camera& camera, const Picture& picture,
                        const Drawing& drawing, const nnao::Network* network) {
  const int w = int(picture.width), h = int(picture.height);
  nook_nnao pass = fixture.pass_of(drawing.taps, drawing.half, drawing.blur, network);
  ScreenFrame frame = frame_desc(camera, w, h, fixture.depth_of(camera, picture),
                                 drawing.normals ? fixture.normals_of(picture) : 0, drawing.radius);
  frame.debug.show = drawing.view;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  return own_ao(fixture.context.gl(), pass, w, h);
}

std::vector<float> rebuilt_normals(NnaoFixture& fixture, const Camera& camera, const Picture& picture) {
  const int w = int(picture.width), h = int(picture.height);
  nook_nnao pass = fixture.pass_of(16, 0, 1, nullptr);
  ScreenFrame frame = frame_desc(camera, w, h, fixture.depth_of(camera, picture), 0, 0.5f);
  frame.target = NOOK_TARGET_TEXTURE;
  frame.target_name =
      fixture.textures.floats(GL_RGBA32F, 4, w, h, std::vector<float>(std::size_t(w) * h * 4));
  frame.debug.show = NOOK_NNAO_VIEW_NORMALS;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  return read_texture(fixture.context.gl(), frame.target_name, w, h, 4);
}

float degrees_off(const std::vector<float>& shown, const Picture& picture, std::size_t pixel) {
  const Vec3 n{2 * shown[4 * pixel] - 1, 2 * shown[4 * pixel + 1] - 1, 2 * shown[4 * pixel + 2] - 1};
  return std::acos(std::clamp(dot(normalised(n), picture.normal[pixel]), -1.0f, 1.0f)) * 57.29578f;
}

bool touches_another_plane(const Picture& picture, std::size_t pixel) {
  const std::size_t w = picture.width, x = pixel % w, y = pixel / w;
  const auto differs = [&](std::size_t other) {
    return length(picture.normal[other] - picture.normal[pixel]) > 1e-3f;
  };
  return (x > 0 && differs(pixel - 1)) || (x + 1 < w && differs(pixel + 1)) ||
         (y > 0 && differs(pixel - w)) || (y + 1 < picture.height && differs(pixel + w));
}

struct Range {
  float low = 1, high = 0;
};
// Takes the pixels at least `margin` from every border.
Range range_inside(const std::vector<float>& ao, int w, int h, int margin) {
  Range range;
  for (int y = margin; y < h - margin; ++y)
    for (int x = margin; x < w - margin; ++x) {
      range.low = std::min(range.low, ao[std::size_t(y) * w + x]);
      range.high = std::max(range.high, ao[std::size_t(y) * w + x]);
    }
  return range;
}

}  // namespace

TEST_CASE("nnao: sky is exactly 1, whatever the network") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
  const std::vector<Camera> all = cameras(16.0f / 9);
  for (const std::size_t camera : {0u, 2u, 4u, 5u, 6u, 7u})
    for (const int half : {0, 1}) {
      const Picture picture = look(all[camera], still_life(), width, height);
      Drawing drawing;
      drawing.half = half;
      const std::vector<float> ao = draw(fixture, all[camera], picture, drawing, &network);
      int sky = 0, wrong = 0;
      for (std::size_t i = 0; i < ao.size(); ++i) {
        const bool is_sky = !std::isfinite(picture.depth[i]);
        sky += is_sky;
        wrong += is_sky && ao[i] != 1;
      }
      INFO(all[camera].name << ", half " << half);
      CHECK(sky > 300);
      CHECK(wrong == 0);
    }
}

TEST_CASE("nnao: linear depth that is not finite, not positive or beyond sky_depth is sky") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  std::vector<float> depth(16 * 16, 2.0f);
  const float odd[] = {std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN(),
                       0.0f,
                       -1.0f,
                       50.0f,
                       1e35f};
  for (std::size_t i = 0; i < std::size(odd); ++i) depth[16 * (2 * i + 1) + 5] = odd[i];
  nook_nnao pass = create_pass(fixture.gl, pass_desc(16, 16), mild_network(nnao::NetworkForm::paper));
  ScreenFrame frame =
      frame_desc(plain_camera(1), 16, 16, fixture.textures.floats(GL_R32F, 1, 16, 16, depth), 0, 0.5f);
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  frame.sky_depth = 50;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const std::vector<float> ao = own_ao(context.gl(), pass, 16, 16);
  for (std::size_t i = 0; i < std::size(odd); ++i) {
    INFO(odd[i]);
    CHECK(ao[16 * (2 * i + 1) + 5] == 1);
  }
  for (const float value : ao) CHECK((value >= 0 && value <= 1));
  nook_nnao_destroy(&pass);
}

TEST_CASE("nnao: a plane is open, to the borders of the screen") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  // Turned by 0, 35 and 60 degrees.
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.57f, 0, 0.82f}, Vec3{0, 0.87f, 0.5f}})
    for (const int half : {0, 1}) {
      const Camera camera = plain_camera(16.0f / 9);
      const Picture picture = look(camera, {plane_through({0, 0, -3}, normal)}, width, height);
      Drawing drawing;
      drawing.half = half;
      drawing.taps = 64;
      drawing.radius = 0.4f;
      const std::vector<float> ao = draw(fixture, camera, picture, drawing, nullptr);
      const float lowest = *std::ranges::min_element(ao);
      INFO("normal " << normal.x << " " << normal.y << " " << normal.z << ", half " << half << ": lowest "
                     << lowest);
      // No unit of the network answers to a plane, and the sky behind its end cannot darken it; rounding may
      // leave a step of 8 bits.
      CHECK(lowest > 1 - 1.5f * step);
    }
}

TEST_CASE("nnao: the filter takes the pattern of the taps away and keeps edges") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  nnao::Network network = mild_network(nnao::NetworkForm::paper, 3);
  for (float& weight : network.paper.filters) weight *= 32;  // back to a loud one
  const Camera camera = cameras(16.0f / 9)[6];
  // On a plane under an orthographic camera AO is a function of the taps' noise alone.
  const Picture flat_wall = look(camera, {plane_through({0, 0, -4}, {0.5f, 0.2f, 0.84f})}, width, height);
  Drawing drawing;
  drawing.radius = 1;
  drawing.view = NOOK_NNAO_VIEW_RAW;
  const std::vector<float> raw = draw(fixture, camera, flat_wall, drawing, &network);
  drawing.view = NOOK_NNAO_VIEW_BLURRED;
  const std::vector<float> blurred = draw(fixture, camera, flat_wall, drawing, &network);
  const Range noise = range_inside(raw, width, height, 18), rest = range_inside(blurred, width, height, 18);
  INFO("raw " << noise.low << " to " << noise.high << ", blurred " << rest.low << " to " << rest.high);
  CHECK(noise.high - noise.low > 8 * step);
  // The filter weighs the nine ninths of the noise alike. What remains is noise of the places within the
  // ninths, a ninth of the whole range at each pixel, and a rounding to 8 bits.
  CHECK(rest.high - rest.low < (noise.high - noise.low) / 4);
}

TEST_CASE("nnao: the filter is the reference's") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon, 5);
  for (const std::size_t camera : {0u, 6u}) {
    const Camera seen_by = cameras(16.0f / 9)[camera];
    const Picture picture = look(seen_by, still_life(), width, height);
    Drawing drawing;
    drawing.radius = 0.8f;
    drawing.view = NOOK_NNAO_VIEW_RAW;
    const std::vector<float> raw = draw(fixture, seen_by, picture, drawing, &network);
    drawing.view = NOOK_NNAO_VIEW_BLURRED;
    const std::vector<float> found = draw(fixture, seen_by, picture, drawing, &network);
    std::vector<std::uint8_t> edges(picture.depth.size());
    for (std::uint32_t y = 0; y < picture.height; ++y)
      for (std::uint32_t x = 0; x < picture.width; ++x)
        if (picture.view().has_surface(x, y))
          edges[picture.view().at(x, y)] =
              nnao::packed_edges(nnao::neighbours_of(picture.view(), x, y, drawing.radius / 16).connected);
    std::vector<float> wanted = raw;
    for (const nnao::FilterAxis axis : {nnao::FilterAxis::x, nnao::FilterAxis::y}) {
      const std::vector<float> before = wanted;
      for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x)
          wanted[picture.view().at(x, y)] =
              std::round(255 * nnao::filtered(before, edges, picture.width, picture.height, x, y, axis,
                                              nnao::filter_range_sharpness(16, axis))) /
              255;
    }
    // Where the rounding to 8 bits after the first axis falls to the other side, the value after the second
    // differs by a third of a step, and may round to the next one. An edge at the limit of two of its four
    // steps may fall to either side.
    const Difference off = difference(found, wanted, 1.1f * step);
    INFO(seen_by.name << ": largest " << off.largest << ", beyond " << off.beyond);
    CHECK(off.beyond < 0.01f);
    CHECK(off.largest < 0.1f);
  }
}

TEST_CASE("nnao: the filter does not cross an edge") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  // The left half is near, the right half far.
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon, 5);
  const Camera camera = cameras(16.0f / 9)[6];
  Picture picture = look(camera, {plane_through({0, 0, -3}, {0, 0, 1})}, width, height);
  for (int y = 0; y < height; ++y)
    for (int x = width / 2; x < width; ++x) picture.depth[std::size_t(y) * width + x] = 3.6f;
  Drawing drawing;
  drawing.radius = 1;
  const std::vector<float> both = draw(fixture, camera, picture, drawing, &network);
  drawing.view = NOOK_NNAO_VIEW_RAW;
  const std::vector<float> raw = draw(fixture, camera, picture, drawing, &network);
  // The mean along y over whole periods comes from the raw columns on the same side alone.
  const auto column_mean = [&](const std::vector<float>& ao, int x) {
    double sum = 0;
    for (int y = 16; y < 37; ++y) sum += double(ao[std::size_t(y) * width + std::size_t(x)]) / 21;
    return sum;
  };
  for (int x = width / 2 - 4; x < width / 2 + 4; ++x) {
    double low = 1, high = 0;
    for (int near = x - 2; near <= x + 2; ++near) {
      if ((near < width / 2) != (x < width / 2)) continue;
      low = std::min(low, column_mean(raw, near));
      high = std::max(high, column_mean(raw, near));
    }
    INFO("column " << x);
    CHECK(column_mean(both, x) > low - double(1.5f * step));
    CHECK(column_mean(both, x) < high + double(1.5f * step));
  }
}

TEST_CASE("nnao: normals rebuilt from depth are the plane's, and do not lean over edges") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(16.0f / 9);
  // A floor, two walls and a step: every pixel lies on a plane.
  const std::vector<Surface> room{plane_through({0, -0.9f, 0}, {0, 1, 0}),
                                  plane_through({0, 0, -5}, {0.1f, 0, 1}),
                                  plane_through({-1.5f, 0, 0}, {1, 0.1f, 0})};
  for (const std::size_t camera : {0u, 2u, 5u, 6u, 7u, 9u, 11u}) {
    const Picture picture = look(all[camera], room, width, height);
    const std::vector<float> shown = rebuilt_normals(fixture, all[camera], picture);
    int off = 0, surface = 0;
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
      if (!std::isfinite(picture.depth[i])) continue;
      // Along a crease the slope between two pixels belongs to neither plane.
      if (touches_another_plane(picture, i)) continue;
      ++surface;
      // Half a degree: depth in 32-bit floats between 0.2 and 40 m.
      off += degrees_off(shown, picture, i) > 0.5f;
    }
    INFO(all[camera].name << ": " << off << " of " << surface << " pixels");
    CHECK(surface > 1000);
    CHECK(off <= surface / 200);
  }
}

TEST_CASE("nnao: a wire one pixel wide faces the viewer") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  for (const Camera& camera : {cameras(16.0f / 9)[0], cameras(16.0f / 9)[6]}) {
    Picture picture = look(camera, {plane_through({0, 0, -5}, {0, 0, 1})}, width, height);
    std::vector<std::size_t> wire;
    for (int y = 5; y < height - 5; ++y) wire.push_back(std::size_t(y) * width + 40);
    for (const std::size_t pixel : wire) picture.depth[pixel] = 2;
    const std::vector<float> shown = rebuilt_normals(fixture, camera, picture);
    // All of these depths belong to planes at right angles to the camera's axis.
    for (std::size_t i = 0; i < picture.depth.size(); ++i) REQUIRE(degrees_off(shown, picture, i) < 0.5f);
  }
}

TEST_CASE("nnao: a sliver one pixel wide before a wall does not turn sideways, however near the wall it is") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  for (const Camera& camera : {cameras(16.0f / 9)[0], cameras(16.0f / 9)[6]}) {
    const Picture wall = look(camera, {plane_through({0, 0, -5}, {0, 0, 1})}, width, height);
    const float pixel_m = std::abs(wall.rays.x_scale) * (wall.rays.orthographic ? 1.0f : 5.0f);
    for (const float pixels_away : {0.5f, 1.0f, 2.0f, 4.0f, 7.0f, 9.0f, 30.0f}) {
      Picture picture = wall;
      for (int y = 5; y < height - 5; ++y)
        picture.depth[std::size_t(y) * width + 40] = 5 - pixels_away * pixel_m;
      const std::vector<float> shown = rebuilt_normals(fixture, camera, picture);
      float worst = 0;
      for (int y = 7; y < height - 7; ++y)
        worst = std::max(worst, degrees_off(shown, picture, std::size_t(y) * width + 40));
      INFO(camera.name << ", " << pixels_away << " pixels before the wall: " << worst << " degrees");
      // Both sides balance; depth is kept in 32-bit floats.
      CHECK(worst < 1);
    }
  }
}

TEST_CASE("nnao: half resolution is near full resolution") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(161.0f / 91);
  const Picture picture = look(camera, still_life(), 161, 91);
  Drawing drawing;
  drawing.taps = 64;
  const std::vector<float> full = draw(fixture, camera, picture, drawing, nullptr);
  drawing.half = 1;
  const std::vector<float> half = draw(fixture, camera, picture, drawing, nullptr);
  const Difference found = difference(full, half, 0.1f);
  INFO("largest " << found.largest << ", mean " << found.mean << ", beyond 0.1 " << found.beyond);
  // Half resolution loses what is narrower than two pixels, along silhouettes and contacts, and it reads the
  // normals of every second pixel.
  CHECK(found.mean < 0.015f);
  CHECK(found.beyond < 0.045f);
}

TEST_CASE("nnao: normals given and normals rebuilt give nearly the same AO") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(16.0f / 9);
  const Picture picture = look(camera, still_life(), 160, 90);
  Drawing drawing;
  drawing.taps = 64;
  const std::vector<float> rebuilt = draw(fixture, camera, picture, drawing, nullptr);
  drawing.normals = true;
  const std::vector<float> given = draw(fixture, camera, picture, drawing, nullptr);
  const Difference found = difference(rebuilt, given, 0.1f);
  INFO("largest " << found.largest << ", mean " << found.mean << ", beyond 0.1 " << found.beyond);
  // Balls are facets of one pixel when rebuilt, and their silhouettes have no second pixel.
  CHECK(found.mean < 0.02f);
  CHECK(found.beyond < 0.03f);
}
