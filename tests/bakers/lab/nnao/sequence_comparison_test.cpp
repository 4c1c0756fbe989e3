// Where surfaces lay in an earlier frame, and the rows of means over frames.
#include "bakers/lab/nnao/sequence_comparison.h"

#include <cmath>

#include "sdk/src/core/failure.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

constexpr float wall_depth = 10, box_depth = 5, box_half = 1;

// A wall behind a box, whose front alone a camera before it sees.
bake::TriangleSoup box_before_wall() {
  bake::TriangleSoup soup;
  bake::nnao::add_quad(soup, {-90, -90, -wall_depth}, {90, -90, -wall_depth}, {90, 90, -wall_depth},
                       {-90, 90, -wall_depth});
  bake::nnao::add_block(soup, {-box_half, -box_half, -box_depth - 0.01f}, {box_half, box_half, -box_depth});
  return soup;
}

bake::nnao::Camera camera_at(float x, float z = 0) {
  return bake::nnao::look_at({x, 0, z}, {x, 0, z - 1}, 0, 0.8f, width, height);
}

// Metres for each pixel at the wall.
float wall_pixel() {
  return camera_at(0).rays.x_scale * wall_depth;
}

MeasuredView measured_path(std::size_t frames) {
  TruthSettings settings;
  settings.width = width;
  settings.height = height;
  settings.rays = 16;
  settings.path.frames = frames;
  bake::TriangleSoup soup = corner();
  bake::nnao::add_block(soup, {-0.3f, 0, 0.5f}, {0.3f, 0.6f, 0.8f});
  return measure_view(bake::RayScene(soup), "corner", camera(), settings);
}

}  // namespace

TEST_CASE("a camera that stands still hides nothing and moves nothing") {
  const bake::nnao::TracedView view = traced(box_before_wall(), camera_at(0));
  const std::vector<EarlierPixels> earlier = earlier_pixels(view, view);
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    REQUIRE(earlier[i].seen());
    for (std::size_t corner = 0; corner < 4; ++corner)
      // A place is off by the rounding of floats, some 1e-5 pixels.
      if (earlier[i].pixel[corner] != i) REQUIRE(earlier[i].weight[corner] < 1e-3f);
  }
}

TEST_CASE("a step to the side uncovers the strip of the wall that the box hid") {
  // Steps of 3 pixels of the wall, which are 6 of the box: the box moves 3 pixels further than the wall, and
  // as much of the wall comes to sight beside it. The image's right border shows 3 new pixels of the wall.
  const float step = 3 * wall_pixel();
  const bake::nnao::TracedView before = traced(box_before_wall(), camera_at(-step)),
                               now = traced(box_before_wall(), camera_at(0));
  const std::vector<EarlierPixels> earlier = earlier_pixels(now, before);
  const std::uint32_t row = height / 2;
  const float right_edge = 0.5f * width + box_half / (camera_at(0).rays.x_scale * box_depth);
  int uncovered = 0;
  for (std::uint32_t x = 0; x < width; ++x) {
    const bool seen = earlier[row * width + x].seen();
    const float centre = float(x) + 0.5f;
    INFO(x);
    if (x >= width - 3) {
      CHECK(!seen);
      continue;
    }
    if (!seen) {
      ++uncovered;
      // One pixel for the edges of box and strip within pixels.
      CHECK(centre > right_edge - 1);
      CHECK(centre < right_edge + 3 + 1);
    }
  }
  // The four pixels around a place at the strip's border may show the wall still.
  CHECK(uncovered >= 2);
  CHECK(uncovered <= 3);
}

TEST_CASE("the warp finds the place of a surface before the step") {
  // Two and a quarter pixels of the wall: the bilinear weights are 0.75 and 0.25.
  const float step = 2.25f * wall_pixel();
  const bake::nnao::TracedView before = traced(box_before_wall(), camera_at(-step)),
                               now = traced(box_before_wall(), camera_at(0));
  const std::vector<EarlierPixels> earlier = earlier_pixels(now, before);
  // Near the lower left corner of the image there is the wall alone.
  const std::uint32_t x = 10, y = 5;
  float place_x = 0, place_y = 0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const EarlierPixels& found = earlier[y * width + x];
    place_x += found.weight[corner] * float(found.pixel[corner] % width);
    place_y += found.weight[corner] * float(found.pixel[corner] / width);
  }
  // Rounding of floats.
  CHECK(std::abs(place_x - (float(x) + 2.25f)) < 1e-3f);
  CHECK(std::abs(place_y - float(y)) < 1e-3f);
  // From view space to view space the camera's step is a translation.
  const Mat3x4 matrix = earlier_from_view(now.camera, before.camera);
  CHECK(std::abs(matrix.m[3] - step) < 1e-5f);
  CHECK(std::abs(matrix.m[7]) + std::abs(matrix.m[11]) < 1e-5f);
}

TEST_CASE("a path ends at its view, by the same step each frame, and stays out of walls") {
  PathSettings settings;
  settings.frames = 4;
  bake::TriangleSoup soup = box_before_wall();
  const bake::nnao::TracedView view = traced(soup, camera_at(0));
  const auto free_way = trace_path(bake::RayScene(soup), view, settings);
  REQUIRE(free_way.size() == 3);
  const auto eye_x = [](const bake::nnao::TracedView& frame) { return frame.camera.world_from_view.m[3]; };
  // 2.7 pixels at the wall, which is the median.
  const float step = settings.step_px * wall_pixel();
  for (int left = 3; left > 0; --left)
    CHECK(std::abs(std::abs(eye_x(free_way[std::size_t(3 - left)])) - float(left) * step) < 1e-4f);

  // Walls close to both sides: half of the way to the farther one.
  bake::nnao::add_quad(soup, {0.1f, -9, 9}, {0.1f, 9, 9}, {0.1f, 9, -9}, {0.1f, -9, -9});
  bake::nnao::add_quad(soup, {-0.2f, -9, 9}, {-0.2f, 9, 9}, {-0.2f, 9, -9}, {-0.2f, -9, -9});
  settings.step_px = 20;
  const auto narrow = trace_path(bake::RayScene(soup), view, settings);
  CHECK(std::abs(eye_x(narrow[0]) + 0.1f) < 1e-3f);

  settings.step_px = 0;
  for (const bake::nnao::TracedView& frame : trace_path(bake::RayScene(soup), view, settings))
    CHECK(eye_x(frame) == eye_x(view));
}

TEST_CASE("sequences have a row for each pass, source and mean, and their ratios") {
  const auto context = make_context();
  const MeasuredView view = measured_path(sequence_frames);
  REQUIRE(view.path.size() == sequence_frames - 1);
  AoRequest request;
  request.max_radius_px = 0.5f * float(height);
  const SequenceView one = measure_sequence(*context, view, request);
  REQUIRE(one.errors.size() == 12);
  // The median surface moves by 2.7 pixels sideways and by some tenths away from the centre.
  CHECK(one.step_px > 2);
  CHECK(one.step_px < 4);
  CHECK(one.disoccluded > 0);
  CHECK(one.disoccluded < one.surfaces / 4);
  for (const SequenceError& error : one.errors) {
    CHECK(error.mse > 0);
    CHECK(error.mse < 0.1);
    CHECK(error.disoccluded_mse > 0);
    CHECK(error.change >= 0);
  }
  // The same pass again draws the same frames.
  const SequenceView again = measure_sequence(*context, view, request);
  CHECK(again.errors[11].mse == one.errors[11].mse);

  const SequenceView views[] = {one, one};
  const auto report = sequence_report(views, 1);
  REQUIRE(report.at("rows").size() == 2 * 12);
  CHECK(report.at("rows").at(0).at("scene") == "corner");
  CHECK(report.at("rows").at(1).at("scene") == "mean");
  CHECK(report.at("rows").at(1).at("mse").get<double>() == Approx(one.errors[0].mse));
  CHECK(report.at("views").size() == 2 * 12);
  // 9 taps of 4 frames over 32 taps of one.
  const auto& ratio = report.at("ratios").at(0);
  CHECK(ratio.at("ratio").get<double>() == Approx(one.errors[4].mse / one.errors[2].mse));
  CHECK(sequence_markdown(report).find("| 16 taps, 4 frames / 64 taps | all |") != std::string::npos);
}

TEST_CASE("a sequence without its path is refused") {
  const auto context = make_context();
  CHECK_THROWS_AS(measure_sequence(*context, measured_path(2), {}), Failure);
}
