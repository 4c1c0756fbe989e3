#include "bakers/measure/nnao/comparison.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "bakers/measure/nnao/image_error.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using bake::nnao::ImageError;

constexpr int network_taps[] = {9, 16, 32, 64, 128, 256};
constexpr int frames = 1;  // timed, of each view

struct Method {
  std::string name;
  int taps = 0;
  std::function<GLuint(const GpuView&, const AoRequest&, bool)> draw;
  int fetches_raw = 0, fetches_blurred = 0;
};

// The view, and the same with the image slid by one pixel.
struct ViewOnGpu {
  ViewOnGpu(const GladGLContext& gl, const MeasuredView& measured)
      : view(gl, measured.view), slid(gl, measured.slid) {}
  GpuView view, slid;
};

double change_when_slid(const std::vector<float>& ao, const std::vector<float>& slid,
                        const MeasuredView& measured) {
  const std::uint32_t width = measured.view.camera.width;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i + 1 < ao.size(); ++i) {
    if (i % width == width - 1 || !std::isfinite(measured.view.depth[i + 1])) continue;
    sum += std::abs(double(ao[i + 1]) - double(slid[i]));
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

double timed_draw(const GladGLContext& gl, const std::function<void()>& draw) {
  gl.Finish();
  platform::Stopwatch watch;
  draw();
  gl.Finish();
  return watch.lap_ms();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

ComparisonRow measure(const GladGLContext& gl, const Method& method, bool blurred,
                      std::span<const MeasuredView> views, const std::deque<ViewOnGpu>& images,
                      AoRequest request, std::vector<KeptImage>* kept) {
  ImageError error;
  bake::nnao::BorderBias border;
  std::vector<double> ms;
  double flicker = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const GpuView& view = images[v].view;
    request.radius = views[v].radius;
    GLuint texture = 0;
    // The first frame of a method is not counted: drivers compile then.
    if (v == 0) method.draw(view, request, blurred);
    for (int i = 0; i < frames; ++i)
      ms.push_back(timed_draw(gl, [&] { texture = method.draw(view, request, blurred); }));
    const std::vector<float> ao = read_red(gl, texture, view.width, view.height);
    error.add(ao, views[v].truth, views[v].view.depth, std::uint32_t(view.width));
    border.add(ao, views[v].truth, views[v].view.depth, std::uint32_t(view.width));
    texture = method.draw(images[v].slid, request, blurred);
    flicker += change_when_slid(ao, read_red(gl, texture, view.width, view.height), views[v]);
    if (kept) kept->push_back({method.name, method.taps, v, ao});
  }
  return {method.name,
          method.taps,
          blurred,
          error.mse(),
          error.ssim(),
          error.correlation(),
          border,
          flicker / double(views.size()),
          blurred ? method.fetches_blurred : method.fetches_raw,
          median(ms)};
}

void add_network(std::vector<Method>& methods, const std::string& name,
                 std::vector<std::unique_ptr<NetworkPass>>& passes, const NookGl& gl, int width, int height,
                 std::span<const std::byte> network, float sharpness) {
  for (const int taps : network_taps) {
    passes.push_back(std::make_unique<NetworkPass>(gl, width, height, taps, network, sharpness));
    NetworkPass* const pass = passes.back().get();
    methods.push_back({name, taps,
                       [pass](const GpuView& view, const AoRequest& request, bool blurred) {
                         return pass->draw(view, request, blurred);
                       },
                       pass->fetches(false), pass->fetches(true)});
  }
}

}  // namespace

Comparison compare(platform::Context& context, std::span<const MeasuredView> views,
                   const ComparisonSettings& settings,
                   const std::function<bool(const std::string&, int)>& keep,
                   const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  const int width = int(views.front().view.camera.width), height = int(views.front().view.camera.height);
  const NookGl nook_gl(context);
  std::deque<ViewOnGpu> images;
  for (const MeasuredView& view : views) images.emplace_back(gl, view);

  const auto wanted = [&](const std::string& name) {
    return settings.methods.empty() || std::ranges::find(settings.methods, name) != settings.methods.end();
  };
  std::vector<Method> methods;
  std::vector<std::unique_ptr<NetworkPass>> passes;
  const float sharpness = settings.request.blur_sharpness;
  if (wanted("nnao")) add_network(methods, "nnao", passes, nook_gl, width, height, {}, sharpness);
  if (!settings.other_network.empty() && wanted(settings.other_name))
    add_network(methods, settings.other_name, passes, nook_gl, width, height, settings.other_network,
                sharpness);
  BaselinePass baselines(gl, width, height);
  for (const BaselineMethod& baseline : baseline_methods())
    if (wanted(baseline_name(baseline.baseline)))
      methods.push_back({baseline_name(baseline.baseline), baseline.taps,
                         [&baselines, baseline](const GpuView& view, const AoRequest& request, bool blurred) {
                           return baselines.draw(baseline, view, request, blurred);
                         },
                         baseline_fetches(baseline), baseline_fetches(baseline) + blur_fetches});

  Comparison comparison;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    for (const bool blurred : {true, false}) {
      const bool kept = blurred && keep(methods[m].name, methods[m].taps);
      comparison.rows.push_back(measure(gl, methods[m], blurred, views, images, settings.request,
                                        kept ? &comparison.images : nullptr));
    }
    if (!progress(m + 1, methods.size())) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
  }
  return comparison;
}

}  // namespace nook::measure
