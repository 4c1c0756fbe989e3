// A recorded frame of a host: what the replay gives beside the recorded AO, the oracle and rays.
#include "bakers/measure/nnao/frame_comparison.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "bakers/measure/nnao/frame_pictures.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/recording_file.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"
#include "tests/nnao/network_sample.h"

using namespace nook;
using namespace nook::measure;
using namespace nook::test;

namespace {

constexpr float near_m = 0.1f, far_m = 60;

// The corner, seen by a host with reversed depth from 0 to 1 and world-space normals in half the range.
nook::nnao::Recording host_frame() {
  const bake::nnao::Camera from = camera();
  const bake::nnao::TracedView view = traced(corner(), from);
  nook::nnao::Recording recording;
  recording.width = width;
  recording.height = height;
  recording.library_version = NOOK_VERSION;
  auto& frame = recording.frame;
  frame.projection[0] = 2 / (from.rays.x_scale * width);
  frame.projection[5] = 2 / (from.rays.y_scale * height);
  frame.projection[10] = near_m / (far_m - near_m);
  frame.projection[11] = -1;
  frame.projection[14] = far_m * near_m / (far_m - near_m);
  frame.clip = 1;
  frame.radius = 0.6f;
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  // Column-major: the columns are the images of the world's axes.
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 v = bake::nnao::view_direction(from, {float(axis == 0), float(axis == 1), float(axis == 2)});
    frame.normal_matrix[3 * axis] = v.x;
    frame.normal_matrix[3 * axis + 1] = v.y;
    frame.normal_matrix[3 * axis + 2] = v.z;
  }
  for (std::size_t i = 0; i < recording.pixels(); ++i) {
    const float depth = view.depth[i];
    recording.depth.push_back(std::isfinite(depth) ? near_m * (far_m - depth) / (depth * (far_m - near_m))
                                                   : 0);
    const Vec3 n = view.normal[i];
    const float* const m = frame.normal_matrix;  // orthonormal: the inverse is the transpose
    for (int axis = 0; axis < 3; ++axis)
      recording.normals.push_back(0.5f +
                                  0.5f * (m[3 * axis] * n.x + m[3 * axis + 1] * n.y + m[3 * axis + 2] * n.z));
  }
  const auto network = nook::nnao::default_network_file();
  recording.network.assign(network.begin(), network.end());
  return recording;
}

const FrameRow& row_of(const std::vector<FrameRow>& rows, const std::string& method) {
  for (const FrameRow& row : rows)
    if (row.method == method) return row;
  FAIL("no row " << method);
  return rows.front();
}

constexpr auto go_on = [](std::size_t, std::size_t) { return true; };

}  // namespace

TEST_CASE("a frame's depth and normals are those that its host drew") {
  const bake::nnao::TracedView drawn = traced(corner(), camera());
  const bake::nnao::TracedView view = view_of_frame(host_frame());
  CHECK(std::abs(view.camera.rays.x_scale / drawn.camera.rays.x_scale - 1) < 1e-5f);
  CHECK(std::abs(view.camera.rays.y_offset / drawn.camera.rays.y_offset - 1) < 1e-5f);
  for (std::size_t i = 0; i < drawn.depth.size(); ++i) {
    // Reversed depth of 32-bit floats has the precision of a float at every distance.
    if (std::isfinite(drawn.depth[i]))
      REQUIRE(std::abs(view.depth[i] - drawn.depth[i]) < 2e-5f * drawn.depth[i]);
    REQUIRE(std::isfinite(view.depth[i]) == std::isfinite(drawn.depth[i]));
    if (std::isfinite(drawn.depth[i])) REQUIRE(length(view.normal[i] - drawn.normal[i]) < 1e-5f);
  }
}

TEST_CASE("a frame replays to its recorded AO, and its errors are those against the oracle") {
  const auto context = make_context();
  const NookGl nook(*context);
  nook::nnao::Recording recording = host_frame();
  recording.pass.taps = 32;
  {
    // The host's own AO.
    const FrameReplay host(context->gl(), nook, recording);
    const std::vector<float> ao = host.draw(recording.pass, {}, NOOK_NNAO_VIEW_AO);
    for (const float value : ao) recording.ao.push_back(std::round(255 * value) / 255);
  }
  const nook::nnao::Recording read = nook::nnao::read_recording(nook::nnao::write_recording(recording));
  FrameReplay replay(context->gl(), nook, read);
  REQUIRE(replay.has_oracle());
  const std::vector<FrameRow> rows = compare_frame(replay, read, {}, {}, go_on);
  std::vector<std::string> names;
  for (const FrameRow& row : rows) names.push_back(row.method);
  CHECK(names == std::vector<std::string>{"recorded", "replayed", "fast", "default", "best", "oracle"});
  const FrameRow& replayed = row_of(rows, "replayed");
  CHECK(replayed.from_recorded.value().largest == 0);
  CHECK(replayed.network == "embedded");
  // The recorded settings are the settings of best.
  CHECK(row_of(rows, "best").from_recorded.value().largest == 0);
  CHECK(row_of(rows, "fast").from_recorded.value().largest > 0.02);
  CHECK(std::abs(row_of(rows, "recorded").oracle_mse.value() - replayed.oracle_mse.value()) < 1e-6);
  CHECK(row_of(rows, "oracle").oracle_mse.value() == 0);
  // The corner is in view whole, so that the oracle is near the truth there, and the pass near the oracle.
  CHECK(replayed.oracle_mse.value() < 5e-3);
  CHECK(std::abs(replayed.oracle_bias.value()) < 0.05);
  const std::vector<float> truth = traced_ao(corner(), traced(corner(), camera()), 0.6f, 64);
  double squared = 0;
  int count = 0;
  for (int y = height / 4; y < 3 * height / 4; ++y)
    for (int x = width / 4; x < 3 * width / 4; ++x, ++count)
      squared += std::pow(row_of(rows, "oracle").ao[std::size_t(y) * width + std::size_t(x)] -
                              truth[std::size_t(y) * width + std::size_t(x)],
                          2);
  // As in oracle_test.cpp, and the noise of 64 rays.
  CHECK(squared / count < 3e-3);

  const auto pictures = frame_pictures(replay.view(), rows);
  REQUIRE(pictures.size() == 2 + rows.size() + 1);
  CHECK(pictures[4].name == "difference");
  for (const std::uint8_t value : pictures[4].image.pixels) REQUIRE(value == 128);
  const platform::Image sheet = picture_sheet(pictures);
  CHECK((sheet.width == 3 * width + 8 && sheet.height == 3 * height + 8));
}

TEST_CASE("a frame keeps its network, and another one is measured beside it") {
  const auto context = make_context();
  const NookGl nook(*context);
  nook::nnao::Recording recording = host_frame();
  const auto own = nook::nnao::write_network(sample_network(nook::nnao::NetworkForm::horizon, 1));
  const auto other = nook::nnao::write_network(sample_network(nook::nnao::NetworkForm::horizon, 2));
  recording.network.assign(own.begin(), own.end());
  FrameReplay replay(context->gl(), nook, recording);
  const auto rows = compare_frame(replay, recording, {"replayed", "nnao_file", "default"}, other, go_on);
  REQUIRE(rows.size() == 3);
  CHECK((rows[0].network == "recorded" && rows[1].network == "file" && rows[2].network == "embedded"));
  // Each picture comes from its own network.
  CHECK(difference_of(rows[0].ao, replay.draw(recording.pass, own, NOOK_NNAO_VIEW_AO)).largest == 0);
  CHECK(difference_of(rows[1].ao, replay.draw(recording.pass, other, NOOK_NNAO_VIEW_AO)).largest == 0);
  CHECK(difference_of(rows[2].ao, replay.draw(recording.pass, {}, NOOK_NNAO_VIEW_AO)).largest == 0);
  CHECK(difference_of(rows[0].ao, rows[1].ao).largest > 0.01);
}

TEST_CASE("a frame with intensity is compared with the oracle without it") {
  const auto context = make_context();
  const NookGl nook(*context);
  nook::nnao::Recording plain = host_frame(), strong = host_frame();
  strong.frame.intensity = 2;
  FrameReplay plain_replay(context->gl(), nook, plain), strong_replay(context->gl(), nook, strong);
  const auto half = [](const FrameReplay&) { return std::vector<float>(std::size_t(width) * height, 0.5f); };
  const std::vector<FrameMethod> grey{{"grey", 1, half}, {"grey", 2, half}};
  const auto of_plain = compare_frame(plain_replay, plain, {"replayed", "oracle", "grey:1"}, {}, go_on, grey);
  const auto of_strong =
      compare_frame(strong_replay, strong, {"replayed", "oracle", "grey:1"}, {}, go_on, grey);
  // Further methods stand between the library's rows and the oracles.
  REQUIRE(of_plain.size() == 3);
  CHECK((of_plain[1].method == "grey" && of_plain[1].pass.taps == 1 && of_plain[2].method == "oracle"));
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(std::abs(of_plain[i].oracle_mse.value() - of_strong[i].oracle_mse.value()) < 1e-9);
  CHECK(difference_of(of_plain[0].ao, of_strong[0].ao).largest > 0.1);
  CHECK(!of_plain[0].from_recorded.has_value());
}

TEST_CASE("a frame without a perspective has no oracle, and a run can be stopped") {
  const auto context = make_context();
  const NookGl nook(*context);
  nook::nnao::Recording recording = host_frame();
  const float parallel[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -0.04f, 0, 0, 0, -1, 1};
  std::ranges::copy(parallel, recording.frame.projection);
  FrameReplay replay(context->gl(), nook, recording);
  CHECK(!replay.has_oracle());
  const std::vector<FrameMethod> further{
      {"none", 1, [](const FrameReplay&) -> std::vector<float> { throw std::logic_error("is not drawn"); }}};
  const auto rows = compare_frame(replay, recording, {"all"}, {}, go_on, further);
  REQUIRE(rows.size() == 4);
  CHECK(!rows[0].oracle_mse.has_value());
  CHECK_THROWS_AS(compare_frame(replay, recording, {}, {}, [](std::size_t, std::size_t) { return false; }),
                  Failure);
}

TEST_CASE("means over frames take the frames that have a number, and the largest difference") {
  FrameRow first, second;
  first.method = second.method = "replayed";
  first.is_library = second.is_library = true;
  first.network = second.network = "embedded";
  first.ao = {0.5f, 0.5f};
  second.ao = {1.0f, 1.0f};
  first.from_recorded = AoDifference{0.1, 0.2, 0};
  second.from_recorded = AoDifference{0.3, 0.6, 0.5};
  first.oracle_mse = 0.01;
  const nook::nnao::Recording recording = host_frame();
  nlohmann::ordered_json rows = frame_rows("a", recording, std::vector{first});
  CHECK(frame_mean_rows(rows).empty());
  for (const auto& row : frame_rows("b", recording, std::vector{second})) rows.push_back(row);
  const auto means = frame_mean_rows(rows);
  REQUIRE(means.size() == 1);
  const auto& mean = means.at(0);
  CHECK(mean.at("frame") == "mean");
  CHECK(std::abs(mean.at("mean_ao").get<double>() - 0.75) < 1e-6);
  CHECK(std::abs(mean.at("mean_difference").get<double>() - 0.2) < 1e-6);
  CHECK(std::abs(mean.at("largest_difference").get<double>() - 0.6) < 1e-6);
  CHECK(std::abs(mean.at("oracle_mse").get<double>() - 0.01) < 1e-6);
}
