#include "bakers/lab/nnao/screen_comparison.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <numeric>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/measure/nnao/oracle_pass.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace measure;

namespace {

constexpr int frames = 1;  // timed frames per view

struct Method {
  std::string name;
  int taps = 0;
  std::function<GLuint(const GpuView&, const AoRequest&, bool)> draw;
  int fetches_raw = 0, fetches_blurred = 0;
  std::string denoiser;    // denoiser that the blurred row uses
  bool is_oracle = false;  // true for oracles: they are drawn only once per view, without a blur, and their
                           // flicker is not measured
};

// Holds a view, and the same view with the image shifted by one pixel.
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

ComparisonRow measure(const GladGLContext& gl, const Method& method, bool blurred,
                      std::span<const MeasuredView> views, const std::deque<ViewOnGpu>& images,
                      AoRequest request,
                      const std::function<void(std::size_t, const std::vector<float>&)>& keep) {
  ComparisonRow row{method.name, method.taps,
                    blurred,     blurred ? method.fetches_blurred : method.fetches_raw,
                    {},          blurred ? method.denoiser : "none"};
  for (std::size_t v = 0; v < views.size(); ++v) {
    Measurement measured;
    const GpuView& view = images[v].view;
    request.radius = views[v].radius;
    GLuint texture = 0;
    // The first frame of a method is not timed, because the driver compiles shaders in it.
    if (v == 0 && !method.is_oracle) method.draw(view, request, blurred);
    for (int i = 0; i < frames; ++i)
      measured.ms.push_back(timed_draw(gl, [&] { texture = method.draw(view, request, blurred); }));
    const std::vector<float> ao = read_red(gl, texture, view.width, view.height);
    measured.error.add(ao, views[v].truth, views[v].view.depth, std::uint32_t(view.width));
    measured.border.add(ao, views[v].truth, views[v].view.depth, std::uint32_t(view.width));
    measured.calibration.add(ao, views[v].truth, views[v].view.depth);
    if (!method.is_oracle) {
      texture = method.draw(images[v].slid, request, blurred);
      measured.flicker.push_back(
          change_when_slid(ao, read_red(gl, texture, view.width, view.height), views[v]));
    }
    if (blurred || method.is_oracle) keep(v, ao);
    row.views.push_back(std::move(measured));
  }
  return row;
}

constexpr NetworkForm plain_forms[] = {{9}, {16}, {32}, {64}, {128}, {256}},
                      half_forms[] = {{9, true}, {16, true}}, twice_forms[] = {{9, false, 2}, {16, false, 2}};

void add_network(std::vector<Method>& methods, const std::string& name, std::span<const NetworkForm> forms,
                 std::vector<std::unique_ptr<NetworkPass>>& passes, const NookGl& gl, int width, int height,
                 std::span<const std::byte> network, float sharpness,
                 const std::function<bool(const std::string&, int)>& wanted) {
  for (const NetworkForm& form : forms) {
    if (!wanted(name, form.taps)) continue;
    passes.push_back(std::make_unique<NetworkPass>(gl, width, height, form, network, sharpness));
    NetworkPass* const pass = passes.back().get();
    methods.push_back({name, form.taps,
                       [pass](const GpuView& view, const AoRequest& request, bool blurred) {
                         return pass->draw(view, request, blurred);
                       },
                       pass->fetches(false), pass->fetches(true), "library"});
  }
}

}  // namespace

void Measurement::add(const Measurement& other) {
  error.add(other.error);
  border.add(other.border);
  calibration.add(other.calibration);
  flicker.insert(flicker.end(), other.flicker.begin(), other.flicker.end());
  ms.insert(ms.end(), other.ms.begin(), other.ms.end());
}

double Measurement::mean_flicker() const {
  if (flicker.empty()) return 0;
  return std::accumulate(flicker.begin(), flicker.end(), 0.0) / double(flicker.size());
}

double Measurement::median_ms() const {
  std::vector<double> values = ms;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Measurement pooled(const ComparisonRow& row, std::span<const std::size_t> which) {
  Measurement all;
  for (const std::size_t view : which) all.add(row.views[view]);
  return all;
}

Comparison compare(platform::Context& context, std::span<const MeasuredView> views,
                   const ComparisonSettings& settings,
                   const std::function<bool(const std::string&, int)>& keep,
                   const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  const int width = int(views.front().view.camera.width), height = int(views.front().view.camera.height);
  const NookGl nook_gl(context);
  std::deque<ViewOnGpu> images;
  for (const MeasuredView& view : views) images.emplace_back(gl, view);

  const auto named = [&](const std::string& name) {
    return std::ranges::find(settings.methods, name) != settings.methods.end();
  };
  const auto wanted = [&](const std::string& name, int taps) {
    return settings.methods.empty() || named("all") || named(name) ||
           named(name + ":" + std::to_string(taps));
  };
  std::vector<Method> methods;
  std::vector<std::unique_ptr<NetworkPass>> passes;
  const float sharpness = settings.request.blur_sharpness;
  add_network(methods, "nnao", plain_forms, passes, nook_gl, width, height, {}, sharpness, wanted);
  add_network(methods, half_name, half_forms, passes, nook_gl, width, height, {}, sharpness, wanted);
  add_network(methods, twice_name, twice_forms, passes, nook_gl, width, height, {}, sharpness, wanted);
  if (!settings.other_network.empty())
    add_network(methods, settings.other_name, plain_forms, passes, nook_gl, width, height,
                settings.other_network, sharpness, wanted);
  BaselinePass baselines(gl, width, height);
  for (const BaselineMethod& baseline : baseline_methods())
    if (wanted(baseline_row(baseline), baseline.taps))
      methods.push_back({baseline_row(baseline), baseline.taps,
                         [&baselines, baseline](const GpuView& view, const AoRequest& request, bool blurred) {
                           return baselines.draw(baseline, view, request, blurred);
                         },
                         baseline_fetches(baseline, false), baseline_fetches(baseline, true),
                         denoiser_name(baseline.tuning.denoiser)});
  const OraclePass oracle_pass(gl, width, height);
  for (const Oracle oracle : all_oracles)
    if (named(oracle_name(oracle)))
      methods.push_back({oracle_name(oracle), oracle_taps,
                         [&oracle_pass, oracle](const GpuView& view, const AoRequest& request, bool) {
                           return oracle_pass.draw(oracle, view, request.radius);
                         },
                         2 + oracle_taps, 2 + oracle_taps, "none", true});

  Comparison comparison;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const bool kept = keep(methods[m].name, methods[m].taps);
    const auto keep_image = [&](std::size_t view, const std::vector<float>& ao) {
      if (kept) comparison.images.push_back({methods[m].name, methods[m].taps, view, ao});
    };
    for (const bool blurred : {true, false})
      if (methods[m].is_oracle ? !blurred : blurred || settings.raw)
        comparison.rows.push_back(
            measure(gl, methods[m], blurred, views, images, settings.request, keep_image));
    if (!progress(m + 1, methods.size())) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
  }
  return comparison;
}

}  // namespace nook::lab
