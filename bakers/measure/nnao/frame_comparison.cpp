#include "bakers/measure/nnao/frame_comparison.h"

#include <algorithm>
#include <cmath>

#include "bakers/measure/nnao/image_error.h"
#include "bakers/measure/nnao/mean.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/taps.h"

namespace nook::measure {
namespace {

using nook::nnao::RecordedPass;
using nook::nnao::Recording;

// The presets of nook_nnao_preset.
struct Preset {
  const char* name;
  int taps;
  int half_resolution;
};
constexpr Preset presets[] = {{"fast", nook::nnao::default_taps, 1},
                              {"default", nook::nnao::default_taps, 0},
                              {"best", nook::nnao::best_taps, 0}};

RecordedPass settings_of(const Preset& preset, float blur_sharpness) {
  return {preset.taps, preset.half_resolution, 1, blur_sharpness, 0};
}

bool is_wanted(const MethodFilter& methods, const std::string& name, int taps) {
  const auto named = [&](const std::string& text) {
    return std::ranges::find(methods, text) != methods.end();
  };
  return named("all") || named(name) || named(name + ":" + std::to_string(taps));
}

// The recorded AO is the pass's own, without intensity, power and layer.
bool is_plain(const Recording& recording) {
  const auto& frame = recording.frame;
  return frame.view == NOOK_NNAO_VIEW_BLURRED ||
         (frame.view == NOOK_NNAO_VIEW_AO && frame.intensity == 1 && frame.power == 1 && frame.layer == 0);
}

// One method to draw.
struct Job {
  FrameRow row;
  std::function<std::vector<float>()> draw;
  std::function<std::vector<float>()> draw_plain;  // null: draw gives it
};

void set_errors(FrameRow& row, const std::vector<float>& plain, const std::vector<float>& oracle,
                const bake::nnao::TracedView& view) {
  bake::nnao::ImageError error;
  error.add(plain, oracle, view.depth, view.camera.width);
  bake::nnao::Mean bias;
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (std::isfinite(view.depth[i])) bias.add(double(plain[i]) - double(oracle[i]));
  row.oracle_mse = error.mse();
  row.oracle_bias = bias.value();
}

}  // namespace

AoDifference difference_of(std::span<const float> a, std::span<const float> b) {
  AoDifference difference;
  // Drivers give the 8 bits of AO as floats that differ in their last bit.
  const auto steps = [](float ao) { return std::lround(255 * double(ao)); };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const long d = std::abs(steps(a[i]) - steps(b[i]));
    difference.mean += double(d) / 255 / double(a.size());
    difference.largest = std::max(difference.largest, double(d) / 255);
    difference.share_beyond += (d > 1) / double(a.size());
  }
  return difference;
}

std::vector<std::string> frame_method_names() {
  std::vector<std::string> names{replayed_name};
  for (const Preset& preset : presets) names.push_back(preset.name);
  return names;
}

std::vector<FrameRow> compare_frame(FrameReplay& replay, const Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress) {
  const nook::nnao::RecordedNetwork network = nook::nnao::recorded_network(recording);
  const bool own_network = network.readable && !network.embedded;
  const auto shown = nook_nnao_view(recording.frame.view);
  std::vector<Job> jobs;
  // file: of the network; empty: the embedded one.
  const auto add_library = [&](const std::string& name, const RecordedPass& settings,
                               std::span<const std::byte> file, const char* named) {
    if (!methods.empty() && !is_wanted(methods, name, settings.taps)) return;
    FrameRow row;
    row.method = name;
    row.pass = settings;
    row.is_library = true;
    row.network = named;
    jobs.push_back({std::move(row), [=, &replay] { return replay.draw(settings, file, shown); },
                    [=, &replay] { return replay.draw(settings, file, NOOK_NNAO_VIEW_BLURRED); }});
  };
  if (own_network)
    add_library(replayed_name, recording.pass, recording.network, "recorded");
  else
    add_library(replayed_name, recording.pass, {}, "embedded");
  if (!other_network.empty()) add_library(file_name, recording.pass, other_network, "file");
  for (const Preset& preset : presets)
    add_library(preset.name, settings_of(preset, recording.pass.blur_sharpness), {}, "embedded");
  std::vector<std::pair<Oracle, FrameRow>> oracles;
  if (replay.has_baselines()) {
    for (const BaselineMethod& method : baseline_methods())
      if (is_wanted(methods, baseline_row(method), method.taps)) {
        FrameRow row;
        row.method = baseline_row(method);
        row.pass.taps = method.taps;
        jobs.push_back({std::move(row), [method, &replay] { return replay.draw(method); }, nullptr});
      }
    for (const Oracle oracle : all_oracles)
      if (methods.empty() ? oracle == Oracle::solid : is_wanted(methods, oracle_name(oracle), oracle_taps)) {
        FrameRow row;
        row.method = oracle_name(oracle);
        row.pass.taps = oracle_taps;
        oracles.push_back({oracle, std::move(row)});
      }
  }

  const std::size_t total = jobs.size() + oracles.size();
  std::size_t done = 0;
  const auto count = [&] {
    if (!progress(++done, total)) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while replaying");
  };
  for (auto& [oracle, row] : oracles) {
    row.ao = replay.draw(oracle);
    count();
  }
  // Errors are those against the first oracle.
  const std::vector<float> truth = oracles.empty() ? std::vector<float>() : oracles.front().second.ao;
  std::vector<FrameRow> rows;
  if (!recording.ao.empty()) {
    FrameRow row;
    row.method = recorded_name;
    row.pass = recording.pass;
    row.is_library = true;
    row.network = network.embedded ? "embedded" : "recorded";
    row.ao.assign(recording.ao.begin(), recording.ao.end());
    if (!truth.empty() && is_plain(recording)) set_errors(row, row.ao, truth, replay.view());
    rows.push_back(std::move(row));
  }
  for (Job& job : jobs) {
    job.row.ao = job.draw();
    const bool has_plain = !job.draw_plain || is_plain(recording);
    if (!truth.empty()) set_errors(job.row, has_plain ? job.row.ao : job.draw_plain(), truth, replay.view());
    rows.push_back(std::move(job.row));
    count();
  }
  for (auto& [oracle, row] : oracles) {
    set_errors(row, row.ao, truth, replay.view());
    rows.push_back(std::move(row));
  }
  if (!recording.ao.empty())
    for (FrameRow& row : rows)
      if (row.method != recorded_name && (row.is_library || is_plain(recording)))
        row.from_recorded = difference_of(row.ao, recording.ao);
  return rows;
}

}  // namespace nook::measure
