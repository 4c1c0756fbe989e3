#include "bakers/measure/nnao/tuning.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <string>

#include "bakers/measure/nnao/baseline_pass.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

constexpr float radius_scales[] = {0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f, 2.5f};
constexpr float powers[] = {0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f, 2.5f, 3.2f};

std::vector<float> shapes_of(Baseline baseline) {
  switch (baseline) {
    case Baseline::ssao:
      return {};
    case Baseline::ssao_plus:
      return {0.01f, 0.03f, 0.06f, 0.1f};
    case Baseline::hbao:
      return {0.0f, 0.05f, 0.1f, 0.2f, 0.35f};
    case Baseline::gtao:
      return {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 0.95f};
    default:
      return {0.1f, 0.2f, 0.35f, 0.6f, 1.0f, 1.6f};
  }
}

struct Search {
  const GladGLContext& gl;
  std::span<const MeasuredView> views;
  std::deque<GpuView> images;
  BaselinePass pass;

  double mse(const BaselineMethod& method) {
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
      AoRequest request;
      request.radius = views[v].radius;
      request.max_radius_px = 0.5f * float(images[v].height);
      const std::vector<float> ao =
          read_red(gl, pass.draw(method, images[v], request, true), images[v].width, images[v].height);
      for (std::size_t i = 0; i < ao.size(); ++i) {
        if (!std::isfinite(views[v].view.depth[i])) continue;
        const double error = double(ao[i]) - double(views[v].truth[i]);
        sum += error * error;
        count += 1;
      }
    }
    return sum / count;
  }

  // Returns whether a candidate is better than `best`, and makes it the best of them if so.
  bool improve(TunedBaseline& best, const std::vector<BaselineTuning>& candidates) {
    bool better = false;
    for (const BaselineTuning& candidate : candidates) {
      const BaselineMethod tried{best.method.baseline, best.method.taps, candidate};
      const double tried_mse = mse(tried);
      if (!(tried_mse < best.mse)) continue;
      best = {tried, tried_mse};
      better = true;
    }
    return better;
  }
};

// The middle of its shapes, its own radius and contrast.
BaselineTuning untuned(Baseline baseline) {
  const std::vector<float> shapes = shapes_of(baseline);
  return {1, 1, shapes.empty() ? 0 : shapes[shapes.size() / 2], false};
}

// A larger radius, less contrast and more thickness darken alike, so that valleys lie across the grid.
std::vector<BaselineTuning> all_radii_and_powers(const BaselineTuning& tuning) {
  std::vector<BaselineTuning> candidates;
  for (const float radius_scale : radius_scales)
    for (const float power : powers)
      candidates.push_back({radius_scale, power, tuning.shape, tuning.equal_weights});
  return candidates;
}

std::vector<BaselineTuning> all_shapes(Baseline baseline, const BaselineTuning& tuning) {
  std::vector<BaselineTuning> candidates;
  for (const float shape : shapes_of(baseline)) {
    candidates.push_back({tuning.radius_scale, tuning.power, shape, tuning.equal_weights});
    if (baseline == Baseline::bitmask)
      candidates.push_back({tuning.radius_scale, tuning.power, shape, !tuning.equal_weights});
  }
  return candidates;
}

bool is_near(std::span<const float> grid, float a, float b) {
  return std::abs(std::ranges::find(grid, a) - std::ranges::find(grid, b)) <= 1;
}

// Returns the neighbours on the grid, diagonal ones included.
std::vector<BaselineTuning> neighbours(Baseline baseline, const BaselineTuning& tuning) {
  std::vector<float> shapes = shapes_of(baseline);
  if (shapes.empty()) shapes = {tuning.shape};
  std::vector<BaselineTuning> candidates;
  for (const float radius_scale : radius_scales)
    for (const float power : powers)
      for (const float shape : shapes)
        if (is_near(radius_scales, radius_scale, tuning.radius_scale) &&
            is_near(powers, power, tuning.power) && is_near(shapes, shape, tuning.shape))
          candidates.push_back({radius_scale, power, shape, tuning.equal_weights});
  return candidates;
}

// before: what this search found for other numbers of taps; it ends in the nearest of several valleys.
TunedBaseline tune(Search& search, Baseline baseline, int taps, std::span<const TunedBaseline> before) {
  const BaselineMethod start{baseline, taps, untuned(baseline)};
  TunedBaseline best{start, search.mse(start)};
  std::vector<BaselineTuning> found;
  for (const TunedBaseline& tuned : before)
    if (tuned.method.baseline == baseline) found.push_back(tuned.method.tuning);
  search.improve(best, found);
  search.improve(best, all_radii_and_powers(best.method.tuning));
  search.improve(best, all_shapes(baseline, best.method.tuning));
  // Each step goes down a finite grid.
  while (search.improve(best, neighbours(baseline, best.method.tuning))) {
  }
  return best;
}

}  // namespace

std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  Search search{
      gl,
      views,
      {},
      BaselinePass(gl, int(views.front().view.camera.width), int(views.front().view.camera.height))};
  for (const MeasuredView& view : views) search.images.emplace_back(gl, view.view);
  std::vector<TunedBaseline> tuned;
  for (const BaselineMethod& method : methods) {
    tuned.push_back(tune(search, method.baseline, method.taps, tuned));
    if (!progress(tuned.size(), methods.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tuning");
  }
  return tuned;
}

std::string tuning_line(const BaselineMethod& method) {
  constexpr const char* names[] = {"ssao", "ssao_plus", "hbao", "gtao", "bitmask"};
  char text[120];
  std::snprintf(text, sizeof text, "    {Baseline::%s, %d, {%.2ff, %.2ff, %.2ff, %s}},\n",
                names[int(method.baseline)], method.taps, double(method.tuning.radius_scale),
                double(method.tuning.power), double(method.tuning.shape),
                method.tuning.equal_weights ? "true" : "false");
  return text;
}

}  // namespace nook::measure
