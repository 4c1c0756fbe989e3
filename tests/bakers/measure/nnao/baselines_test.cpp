// Every baseline against what is known: planes and skies are open, the AO of a corner has a closed form, and
// the blur is the library's.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bakers/measure/nnao/network_pass.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::nnao;
using namespace nook::measure;
using namespace nook::test;

namespace {

// As published: without the tuned contrast and radius; occluders count in full nearly to the radius, and are
// solid.
BaselineMethod untuned(BaselineMethod method) {
  method.tuning.power = 1;
  method.tuning.radius_scale = 1;
  if (method.baseline == Baseline::gtao) method.tuning.shape = 0.9f;
  if (method.baseline == Baseline::bitmask) method.tuning.shape = 1;
  return method;
}

std::vector<float> draw(platform::Context& context, const BaselineMethod& method, const TracedView& view,
                        float radius, bool blurred) {
  BaselinePass pass(context.gl(), width, height);
  const GpuView images(context.gl(), view);
  AoRequest request;
  request.radius = radius;
  request.max_radius_px = 0.5f * float(height);
  const GLuint texture = pass.draw(method, images, request, blurred);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  return read_red(context.gl(), texture, width, height);
}

// The AO of a row of pixels, so that the noise averages out.
float row_mean(const std::vector<float>& ao, int row) {
  const auto first = ao.begin() + row * width;
  // The outermost columns miss what lies off the screen.
  return std::accumulate(first + 24, first + width - 24, 0.0f) / float(width - 48);
}

}  // namespace

TEST_CASE("every baseline leaves an open plane open") {
  const auto context = make_context();
  const TracedView view = traced(plane(), camera());
  for (const BaselineMethod& method : baseline_methods()) {
    const std::vector<float> ao = draw(*context, untuned(method), view, 0.3f, false);
    const float mean = std::accumulate(ao.begin(), ao.end(), 0.0f) / float(ao.size());
    INFO(baseline_name(method.baseline) << ' ' << method.taps << " mean " << mean);
    // SSAO clips what exceeds 1: with n points, half of them closed, 2 (open share) falls short by about 0.4
    // / sqrt(n). GTAO and the bitmask take a texel's angle for that of their slice. SSAO+ and HBAO allow for
    // texels.
    const bool slices = method.baseline == Baseline::gtao || method.baseline == Baseline::bitmask;
    const float bound = method.baseline == Baseline::ssao        ? 0.5f / std::sqrt(float(method.taps))
                        : method.baseline == Baseline::ssao_plus ? 0.01f
                        : slices                                 ? 0.03f
                                                                 : 0.004f;
    CHECK(mean > 1 - bound);
  }
}

TEST_CASE("the sky is exactly open for every baseline, and occludes nothing") {
  const auto context = make_context();
  TracedView view = traced(plane(), camera());
  for (std::size_t i = 0; i < view.depth.size(); ++i)
    if (i % width < width / 2) {
      view.depth[i] = std::numeric_limits<float>::infinity();
      view.normal[i] = {};
    }
  for (const BaselineMethod& method : baseline_methods()) {
    const std::vector<float> ao = draw(*context, method, view, 0.3f, true);
    INFO(baseline_name(method.baseline) << ' ' << method.taps);
    bool sky_open = true;
    for (std::size_t i = 0; i < ao.size(); ++i) sky_open = sky_open && (i % width >= width / 2 || ao[i] == 1);
    CHECK(sky_open);
    const std::vector<float> whole = draw(*context, method, traced(plane(), camera()), 0.3f, true);
    // Beside the sky no pixel is darker than in the middle of the plane, but for a level of rounding in each
    // of three stages.
    bool darker = false;
    for (std::size_t i = 0; i < ao.size(); ++i)
      if (i % width >= width / 2)
        darker = darker || ao[i] < *std::min_element(whole.begin(), whole.end()) - 0.012f;
    CHECK_FALSE(darker);
  }
}

TEST_CASE("baselines know the AO of a right-angled corner") {
  // With rays of length R the AO at distance d from the corner's line follows from the part of the hemisphere
  // whose rays meet the wall within R; traced here with 4096 rays, an error of 0.003.
  const auto context = make_context();
  const TriangleSoup soup = corner();
  const RayScene rays(soup);
  const TracedView view = traced(soup, camera());
  constexpr float radius = 0.5f;
  const std::vector<float> truth = trace_truth(rays, view, radius, 1024, 1);
  for (const BaselineMethod& method : baseline_methods()) {
    if (method.taps < 16) continue;
    const std::vector<float> ao = draw(*context, untuned(method), view, radius, false);
    const std::vector<float> tuned = draw(*context, method, view, radius, true);
    INFO(baseline_name(method.baseline) << ' ' << method.taps);
    // One pixel row above the line, and a quarter of the radius away from it.
    for (const int row : {height / 2 + 1, height / 2 + 6}) {
      INFO("row " << row << " ao " << row_mean(ao, row) << " tuned " << row_mean(tuned, row) << " truth "
                  << row_mean(truth, row));
      // The cosine-weighted methods are exact but for fading, steps and sectors; the others answer other
      // questions (points in a volume, horizons of equal weight) and come near by their tuning.
      const bool cosine_weighted = method.baseline == Baseline::bitmask || method.baseline == Baseline::gtao;
      if (cosine_weighted && method.taps >= 32)
        CHECK(std::abs(row_mean(ao, row) - row_mean(truth, row)) < 0.1f);
      CHECK(std::abs(row_mean(tuned, row) - row_mean(truth, row)) < 0.25f);
    }
    // It darkens towards the line.
    CHECK(row_mean(ao, height / 2 + 1) < row_mean(ao, height / 2 + 10) - 0.05f);
  }
}

TEST_CASE("light passes behind a thin bar in the bitmask and not in GTAO") {
  // A bar in front of a wall, farther away than it is thick; GTAO takes it for a block that reaches the wall.
  const auto context = make_context();
  TriangleSoup soup;
  add_quad(soup, {-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
  add_block(soup, {-9, -0.02f, 0.3f}, {9, 0.02f, 0.34f});
  const TracedView view = traced(soup, look_at({0, 0.01f, 3}, {0, 0, 0}, 0, 0.8f, width, height));
  const RayScene rays(soup);
  constexpr float radius = 0.6f;
  const std::vector<float> truth = trace_truth(rays, view, radius, 256, 1);
  BaselineMethod gtao{Baseline::gtao, 64, {1, 1, 0.9f, false}},
      bitmask{Baseline::bitmask, 64, {1, 1, 0.1f, true}};
  const int row = height / 2 + 4;  // the wall just above the bar
  const float by_gtao = row_mean(draw(*context, gtao, view, radius, false), row);
  const float by_bitmask = row_mean(draw(*context, bitmask, view, radius, false), row);
  INFO("gtao " << by_gtao << " bitmask " << by_bitmask << " truth " << row_mean(truth, row));
  CHECK(by_bitmask > by_gtao + 0.1f);
  CHECK(std::abs(by_bitmask - row_mean(truth, row)) < std::abs(by_gtao - row_mean(truth, row)));
}

TEST_CASE("the baselines' blur is the library's") {
  const auto context = make_context();
  const TracedView view = traced(corner(), camera());
  const GpuView images(context->gl(), view);
  AoRequest request;
  request.max_radius_px = 0.5f * float(height);
  std::vector<float> by_library, by_peers;
  {
    const NookGl gl(*context);
    NetworkPass network(gl, width, height, 16, {}, request.blur_sharpness);
    BaselinePass baselines(context->gl(), width, height);
    by_library = read_red(context->gl(), network.draw(images, request, true), width, height);
    const GLuint raw = network.draw(images, request, false);
    by_peers = read_red(context->gl(), baselines.blur(raw, images, request), width, height);
  }
  float largest = 0;
  for (std::size_t i = 0; i < by_library.size(); ++i)
    largest = std::max(largest, std::abs(by_library[i] - by_peers[i]));
  // Both round to 1/255 between the axes, from normals of which the library's have 16 bits: two levels.
  CHECK(largest < 2.1f / 255);
  CHECK(context->gl().GetError() == GL_NO_ERROR);
}
