// A body that moves before a scene: motion vectors, what it uncovers, errors of means over frames.
#include <cmath>

#include "bakers/lab/nnao/mover_comparison.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/history.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

constexpr float wall_depth = 10, body_depth = 5;

bake::TriangleSoup wall() {
  bake::TriangleSoup soup;
  bake::nnao::add_quad(soup, {-90, -90, -wall_depth}, {90, -90, -wall_depth}, {90, 90, -wall_depth},
                       {-90, 90, -wall_depth});
  return soup;
}

bake::nnao::Camera straight_camera() {
  return bake::nnao::look_at({0, 0, 0}, {0, 0, -1}, 0, 0.8f, width, height);
}

// Metres for each pixel at a depth.
float pixel_m(float depth) {
  return straight_camera().rays.x_scale * depth;
}

// A square before the camera, of 16 x 16 smaller ones, which slides to the right and grows around its middle
// from frame to frame. In the last frame its middle is on the axis and its sides are 2 half, metres.
MovingBody square(std::size_t frames, float step, float growth, float depth = body_depth, float half = 1) {
  MovingBody body;
  for (std::size_t f = 0; f < frames; ++f) {
    const auto left = float(frames - 1 - f);
    const float side = half * std::pow(growth, -left);
    bake::TriangleSoup sheet;
    bake::nnao::add_sheet(sheet, 16, 16, [&](float u, float v) {
      return Vec3{-left * step + side * (2 * u - 1), side * (2 * v - 1), -depth};
    });
    body.triangle = sheet.triangle;
    body.position.push_back(sheet.position);
  }
  return body;
}

MovingBody joined(MovingBody body, const MovingBody& other) {
  const auto first = std::uint32_t(body.position[0].size());
  for (const auto& [a, b, c] : other.triangle) body.triangle.push_back({first + a, first + b, first + c});
  for (std::size_t f = 0; f < body.position.size(); ++f)
    body.position[f].insert(body.position[f].end(), other.position[f].begin(), other.position[f].end());
  return body;
}

TruthSettings settings_of(std::size_t frames, float step_px = 0) {
  TruthSettings settings;
  settings.width = width;
  settings.height = height;
  settings.rays = 16;
  settings.path.frames = frames;
  settings.path.step_px = step_px;
  return settings;
}

}  // namespace

TEST_CASE("motion vectors follow the skin, and the camera where nothing moves") {
  const float step = 2.25f * pixel_m(body_depth), growth = 1.25f;
  const MoverView view = trace_mover(wall(), square(3, step, growth), straight_camera(), settings_of(3));
  REQUIRE(view.motion.size() == 3);
  CHECK(view.motion[0] == std::vector<float>(2 * width * height));
  std::size_t on_body = 0;
  for (std::size_t i = 0; i < view.part.size(); ++i) {
    const float across = float(i % width) + 0.5f - 0.5f * width, up = float(i / width) + 0.5f - 0.5f * height;
    const bool body = view.part[i] == MoverPart::mover;
    on_body += body;
    // A point of the square was nearer to its middle by the growth, and the middle further to the left.
    const float shrunk = body ? 1 - 1 / growth : 0.0f, slid = body ? 2.25f : 0.0f;
    // Rounding of floats in two changes of space.
    CHECK(std::abs(view.motion[2][2 * i] - (slid + shrunk * across)) < 2e-3f);
    CHECK(std::abs(view.motion[2][2 * i + 1] - shrunk * up) < 2e-3f);
  }
  const float side_px = 2 / pixel_m(body_depth);
  CHECK(std::abs(float(on_body) - side_px * side_px) < 2 * side_px);
}

TEST_CASE("motion vectors have the camera's own motion") {
  const MoverView view = trace_mover(wall(), square(2, 0, 1), straight_camera(), settings_of(2, 3));
  const std::vector<EarlierPixels> earlier = earlier_pixels(view.measured.view, view.measured.path[0]);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < view.part.size(); ++i) {
    if (!earlier[i].seen()) continue;
    float x = 0, y = 0, whole = 0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      x += earlier[i].weight[corner] * float(earlier[i].pixel[corner] % width);
      y += earlier[i].weight[corner] * float(earlier[i].pixel[corner] / width);
      whole += earlier[i].weight[corner] > 0;
    }
    // At the square's border a part of the four pixels is left out.
    if (whole < 4) continue;
    ++compared;
    CHECK(std::abs(float(i % width) - x - view.motion[1][2 * i]) < 2e-3f);
    CHECK(std::abs(float(i / width) - y - view.motion[1][2 * i + 1]) < 2e-3f);
  }
  CHECK(compared > view.part.size() / 2);
}

TEST_CASE("what a body uncovers is the strip that it left in the recent frames") {
  // Steps of 4 pixels: the strip to the left of the square has 4 for each recent frame.
  const MoverView view =
      trace_mover(wall(), square(6, 4 * pixel_m(body_depth), 1), straight_camera(), settings_of(6));
  const std::size_t row = height / 2;
  const float left_edge = 0.5f * width - 1 / pixel_m(body_depth);
  for (std::size_t x = 0; x < width; ++x) {
    const float from_edge = left_edge - (float(x) + 0.5f);
    const MoverPart part = view.part[row * width + x];
    INFO(x);
    // A pixel at either end, where the four pixels around a place show both.
    if (from_edge > 1 && from_edge < 4 * recent_frames - 1) CHECK(part == MoverPart::uncovered);
    // The wall is 5 m behind, beyond the radius.
    if (from_edge > 4 * recent_frames + 1) CHECK(part == MoverPart::elsewhere);
  }
  CHECK_THROWS_AS(trace_mover(wall(), square(6, 0, 1), straight_camera(), settings_of(5)), Failure);
}

TEST_CASE("a mean over frames follows a body by its motion vectors and leaves no trail") {
  const auto context = make_context();
  // A square that slides 0.2 m before the wall, by 3 pixels a frame, with half of it 0.2 m before it.
  const float depth = wall_depth - 0.2f;
  AoRequest request;
  request.max_radius_px = 0.5f * float(height);
  const auto measured = [&](const char* name, float step_px) {
    const float step = step_px * pixel_m(depth);
    const MovingBody body =
        joined(square(mover_frames, step, 1, depth, 2), square(mover_frames, step, 1, depth - 0.2f, 1));
    // Twelve pixels, so that AO changes little over a step.
    TruthSettings settings = settings_of(mover_frames);
    settings.radius = 12 * pixel_m(depth);
    MeasuredMover mover =
        measure_mover(*context, trace_mover(wall(), body, straight_camera(), settings), request, nullptr);
    mover.character = name;
    return mover;
  };
  const MeasuredMover still = measured("still", 0), slides = measured("slides", 3);
  REQUIRE(still.errors.size() == 9);
  const auto mse = [](const MeasuredMover& mover, std::size_t error, MoverPart part) {
    return mover.errors[error].mse[std::size_t(part)];
  };
  CHECK(still.pixels[std::size_t(MoverPart::uncovered)] == 0);
  CHECK(slides.pixels[std::size_t(MoverPart::uncovered)] >= fewest_part_pixels);
  for (std::size_t single = 0; single < 9; single += 3) {
    INFO(slides.errors[single].taps << " taps");
    const std::size_t vectors = single + 1, cameras = single + 2;
    // Vectors of 0 belong to a camera that stands still; rounding of floats moves its places.
    for (const MoverPart part : {MoverPart::mover, MoverPart::beside})
      CHECK(mse(still, vectors, part) == Approx(mse(still, cameras, part)).epsilon(0.01));
    CHECK(mse(slides, vectors, MoverPart::mover) < mse(slides, cameras, MoverPart::mover));
    // Noise of the taps is a part of the error of one frame, and the last frames' patterns differ.
    for (const MoverPart part : {MoverPart::mover, MoverPart::elsewhere})
      CHECK(mse(slides, vectors, part) < 1.2 * mse(slides, single, part) + 1e-4);
    // Where AO changes, seven of eight frames lag, each by noise_reach at most.
    const double lag = 7.0 / 8 * double(nook::nnao::noise_reach(std::uint32_t(slides.errors[single].taps)));
    for (const MoverPart part : {MoverPart::beside, MoverPart::uncovered})
      CHECK(std::sqrt(mse(slides, vectors, part)) < std::sqrt(mse(slides, single, part)) + lag);
  }

  const MeasuredMover movers[] = {still, slides};
  const auto report = mover_report(movers, 1);
  REQUIRE(report.at("rows").size() == 3 * 9);
  CHECK(report.at("rows").at(2).at("character") == "mean");
  CHECK(report.at("rows").at(2).at("mover_mse").get<double>() ==
        Approx(0.5 * (mse(still, 0, MoverPart::mover) + mse(slides, 0, MoverPart::mover))));
  CHECK(report.at("rows").at(0).at("uncovered_mse").is_null());
  REQUIRE(report.at("ratios").size() == 6 * 4);
  const auto& ratio = report.at("ratios").at(0);
  CHECK(ratio.at("part") == "mover");
  CHECK(ratio.at("ratio").get<double>() ==
        Approx(std::sqrt(mse(still, 1, MoverPart::mover) / mse(still, 0, MoverPart::mover) *
                         mse(slides, 1, MoverPart::mover) / mse(slides, 0, MoverPart::mover))));
  CHECK(mover_markdown(report).find("| 9 | 8 frames, motion vectors | uncovered |") != std::string::npos);
}
