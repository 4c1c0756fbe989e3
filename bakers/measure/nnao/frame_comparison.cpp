#include "bakers/measure/nnao/frame_comparison.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "bakers/measure/nnao/image_error.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/taps.h"

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;
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

// Returns true if the recorded AO is the unmodified output of the pass, without intensity, power and layer.
bool is_plain(const Recording& recording) {
  const auto& frame = recording.frame;
  return frame.view == NOOK_NNAO_VIEW_BLURRED ||
         (frame.view == NOOK_NNAO_VIEW_AO && frame.intensity == 1 && frame.power == 1 && frame.layer == 0);
}

// A method that will be drawn.
struct Job {
  FrameRow row;
  std::function<std::vector<float>()> draw;
  std::function<std::vector<float>()> draw_plain;  // null: use `draw`
};

void set_errors(FrameRow& row, const std::vector<float>& plain, const std::vector<float>& oracle,
                const bake::nnao::TracedView& view) {
  ImageError error;
  error.add(plain, oracle, view.depth, view.camera.width);
  Mean bias;
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (std::isfinite(view.depth[i])) bias.add(double(plain[i]) - double(oracle[i]));
  row.oracle_mse = error.mse();
  row.oracle_bias = bias.value();
}

}  // namespace

AoDifference difference_of(std::span<const float> a, std::span<const float> b) {
  AoDifference difference;
  // Compares 8-bit values, because drivers convert them to floats that differ in the last bit.
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

namespace {

// Returns jobs for the recorded settings, for these settings with another network, and for the presets.
std::vector<Job> library_jobs(FrameReplay& replay, const Recording& recording, const MethodFilter& methods,
                              std::span<const std::byte> other_network) {
  const nook::nnao::RecordedNetwork network = nook::nnao::recorded_network(recording);
  const auto shown = nook_nnao_view(recording.frame.view);
  std::vector<Job> jobs;
  // `file` holds the bytes of a network file. If it is empty, the embedded network is used.
  const auto add = [&](const std::string& name, const RecordedPass& settings, std::span<const std::byte> file,
                       const char* named) {
    if (!methods.empty() && !is_wanted(methods, name, settings.taps)) return;
    FrameRow row;
    row.method = name;
    row.pass = settings;
    row.is_library = true;
    row.network = named;
    jobs.push_back({std::move(row), [=, &replay] { return replay.draw(settings, file, shown); },
                    [=, &replay] { return replay.draw(settings, file, NOOK_NNAO_VIEW_BLURRED); }});
  };
  if (network.readable && !network.embedded)
    add(replayed_name, recording.pass, recording.network, "recorded");
  else
    add(replayed_name, recording.pass, {}, "embedded");
  if (!other_network.empty()) add(file_name, recording.pass, other_network, "file");
  for (const Preset& preset : presets)
    add(preset.name, settings_of(preset, recording.pass.blur_sharpness), {}, "embedded");
  return jobs;
}

FrameRow row_of(const std::string& method, int taps) {
  FrameRow row;
  row.method = method;
  row.pass.taps = taps;
  return row;
}

std::vector<Oracle> wanted_oracles(const MethodFilter& methods) {
  if (methods.empty()) return {Oracle::solid};
  std::vector<Oracle> wanted;
  for (const Oracle oracle : all_oracles)
    if (is_wanted(methods, oracle_name(oracle), oracle_taps)) wanted.push_back(oracle);
  return wanted;
}

// `truth` is the AO of the first oracle. It is empty if there is no oracle.
FrameRow recorded_row(const FrameReplay& replay, const Recording& recording,
                      const std::vector<float>& truth) {
  FrameRow row;
  row.method = recorded_name;
  row.pass = recording.pass;
  row.is_library = true;
  row.network = nook::nnao::recorded_network(recording).embedded ? "embedded" : "recorded";
  row.ao.assign(recording.ao.begin(), recording.ao.end());
  if (!truth.empty() && is_plain(recording)) set_errors(row, row.ao, truth, replay.view());
  return row;
}

}  // namespace

std::vector<FrameRow> compare_frame(FrameReplay& replay, const Recording& recording,
                                    const MethodFilter& methods, std::span<const std::byte> other_network,
                                    const std::function<bool(std::size_t, std::size_t)>& progress,
                                    std::span<const FrameMethod> further) {
  std::vector<Job> jobs = library_jobs(replay, recording, methods, other_network);
  std::vector<FrameRow> oracles;
  if (replay.has_oracle())
    for (const FrameMethod& method : further)
      if (is_wanted(methods, method.name, method.taps))
        jobs.push_back(
            {row_of(method.name, method.taps), [&method, &replay] { return method.draw(replay); }, nullptr});
  const std::vector<Oracle> wanted = replay.has_oracle() ? wanted_oracles(methods) : std::vector<Oracle>();
  std::size_t done = 0;
  const auto count = [&] {
    if (!progress(++done, jobs.size() + wanted.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while replaying");
  };
  for (const Oracle oracle : wanted) {
    oracles.push_back(row_of(oracle_name(oracle), oracle_taps));
    oracles.back().ao = replay.draw(oracle);
    count();
  }
  // Errors are relative to the first oracle.
  const std::vector<float> truth = oracles.empty() ? std::vector<float>() : oracles.front().ao;
  std::vector<FrameRow> rows;
  if (!recording.ao.empty()) rows.push_back(recorded_row(replay, recording, truth));
  for (Job& job : jobs) {
    job.row.ao = job.draw();
    const bool has_plain = !job.draw_plain || is_plain(recording);
    if (!truth.empty()) set_errors(job.row, has_plain ? job.row.ao : job.draw_plain(), truth, replay.view());
    rows.push_back(std::move(job.row));
    count();
  }
  for (FrameRow& row : oracles) {
    set_errors(row, row.ao, truth, replay.view());
    rows.push_back(std::move(row));
  }
  if (!recording.ao.empty())
    for (FrameRow& row : rows)
      if (row.method != recorded_name && (row.is_library || is_plain(recording)))
        row.from_recorded = difference_of(row.ao, recording.ao);
  return rows;
}

namespace {

template <class Number>
Json or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

double mean_of(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return values.empty() ? 0 : sum / double(values.size());
}

bool same_method(const Json& a, const Json& b) {
  return a["method"] == b["method"] && a["taps"] == b["taps"] && a["half"] == b["half"] &&
         a["blur"] == b["blur"] && a["network"] == b["network"];
}

}  // namespace

Json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                std::span<const FrameRow> rows) {
  Json out = Json::array();
  for (const FrameRow& row : rows) {
    const bool has_difference = row.from_recorded.has_value();
    const AoDifference difference = row.from_recorded.value_or(AoDifference{});
    const auto of_difference = [&](double value) { return has_difference ? Json(value) : Json(); };
    out.push_back({{"frame", frame},
                   {"method", row.method},
                   {"taps", row.pass.taps},
                   {"half", row.is_library ? Json(row.pass.half_resolution != 0) : Json()},
                   {"blur", row.is_library ? Json(row.pass.blur) : Json()},
                   {"network", row.is_library ? Json(row.network) : Json()},
                   {"resolution", std::to_string(recording.width) + "x" + std::to_string(recording.height)},
                   {"mean_ao", mean_of(row.ao)},
                   {"mean_difference", of_difference(difference.mean)},
                   {"largest_difference", of_difference(difference.largest)},
                   {"share_beyond_step", of_difference(difference.share_beyond)},
                   {"oracle_mse", or_null(row.oracle_mse)},
                   {"oracle_bias", or_null(row.oracle_bias)}});
  }
  return out;
}

Json frame_mean_rows(const Json& rows) {
  Json means = Json::array();
  std::set<std::string> frames;
  for (const Json& row : rows) frames.insert(row["frame"].get<std::string>());
  if (frames.size() < 2) return means;
  for (const Json& row : rows) {
    if (std::ranges::any_of(means, [&](const Json& mean) { return same_method(mean, row); })) continue;
    Json mean = row;
    mean["frame"] = "mean";
    mean["resolution"] = nullptr;
    for (const char* key : {"mean_ao", "mean_difference", "largest_difference", "share_beyond_step",
                            "oracle_mse", "oracle_bias"}) {
      double sum = 0, largest = 0, count = 0;
      for (const Json& other : rows) {
        if (!same_method(other, row) || other[key].is_null()) continue;
        sum += other[key].get<double>();
        largest = std::max(largest, other[key].get<double>());
        count += 1;
      }
      if (count > 0) mean[key] = std::string(key) == "largest_difference" ? largest : sum / count;
    }
    means.push_back(mean);
  }
  return means;
}

}  // namespace nook::measure
