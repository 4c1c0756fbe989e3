// The baselines among the rows of a recorded frame.
#include <nook/nook_nnao.h>

#include "bakers/lab/nnao/baseline_pass.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

// The corner as a host with linear depth records it.
nook::nnao::Recording corner_frame() {
  const bake::nnao::Camera from = camera();
  const bake::nnao::TracedView view = traced(corner(), from);
  nook::nnao::Recording recording;
  recording.width = width;
  recording.height = height;
  recording.library_version = NOOK_VERSION;
  auto& frame = recording.frame;
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  frame.projection[0] = 2 / (from.rays.x_scale * width);
  frame.projection[5] = 2 / (from.rays.y_scale * height);
  frame.projection[10] = frame.projection[11] = -1;
  frame.projection[14] = -0.02f;
  frame.radius = 0.6f;
  recording.depth.assign(view.depth.begin(), view.depth.end());
  const auto network = nook::nnao::default_network_file();
  recording.network.assign(network.begin(), network.end());
  return recording;
}

std::vector<std::string> names_of(const std::vector<FrameRow>& rows) {
  std::vector<std::string> names;
  for (const FrameRow& row : rows) names.push_back(row.method + ":" + std::to_string(row.pass.taps));
  return names;
}

}  // namespace

TEST_CASE("baselines stand between the presets and the oracle of a frame, where they are named") {
  const auto context = make_context();
  const GladGLContext& gl = context->gl();
  const NookGl nook(*context);
  const nook::nnao::Recording recording = corner_frame();
  FrameReplay replay(gl, nook, recording);
  const auto go_on = [](std::size_t, std::size_t) { return true; };
  const std::vector<FrameMethod> baselines = frame_baselines(gl);
  const auto rows =
      compare_frame(replay, recording, {"hbao:16", "oracle", "ssao", "fast"}, {}, go_on, baselines);
  CHECK(names_of(rows) ==
        std::vector<std::string>{"fast:9", "ssao:4", "ssao:8", "ssao:16", "hbao:16", "oracle:1024"});
  for (const FrameRow& row : compare_frame(replay, recording, {}, {}, go_on, baselines))
    CHECK((row.is_library || row.method == "oracle"));
}

TEST_CASE("a frame's baseline is the one that views are measured with") {
  const auto context = make_context();
  const GladGLContext& gl = context->gl();
  const NookGl nook(*context);
  const nook::nnao::Recording recording = corner_frame();
  FrameReplay replay(gl, nook, recording);
  AoRequest request;
  request.radius = 0.6f;
  request.max_radius_px = 0.25f * height;  // the library's own limit
  request.blur_sharpness = recording.pass.blur_sharpness;
  const GpuView view(gl, view_of_frame(recording));
  BaselinePass pass(gl, width, height);
  for (const FrameMethod& method : frame_baselines(gl)) {
    const auto same = [&](const BaselineMethod& other) {
      return baseline_row(other) == method.name && other.taps == method.taps;
    };
    const BaselineMethod& baseline = *std::ranges::find_if(baseline_methods(), same);
    INFO(method.name << ' ' << method.taps);
    CHECK(method.draw(replay) == read_red(gl, pass.draw(baseline, view, request, true), width, height));
  }
}
