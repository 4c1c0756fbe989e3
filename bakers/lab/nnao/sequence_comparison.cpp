#include "bakers/lab/nnao/sequence_comparison.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

#include "bakers/lab/nnao/row_statistics.h"
#include "bakers/measure/nnao/network_pass.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

using bake::nnao::TracedView;

constexpr int measured_taps[] = {9, 16, 32, 64};
constexpr std::size_t measured_paths[] = {4, sequence_frames};  // frames
constexpr int longest_mean = 8;                                 // nook_nnao_desc.max_history_frames

// The frames of a path in order. The last frame is the view.
struct Path {
  std::vector<const TracedView*> frames;
  std::vector<std::vector<EarlierPixels>> earlier;  // for each frame except the first
};

Path path_of(const MeasuredView& view) {
  Path path;
  for (const TracedView& frame : view.path) path.frames.push_back(&frame);
  path.frames.push_back(&view.view);
  for (std::size_t f = 1; f < path.frames.size(); ++f)
    path.earlier.push_back(earlier_pixels(*path.frames[f], *path.frames[f - 1]));
  return path;
}

double change_between(const std::vector<float>& now, const std::vector<float>& before,
                      const std::vector<EarlierPixels>& earlier) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!earlier[i].seen()) continue;
    double ao = 0;
    for (std::size_t corner = 0; corner < 4; ++corner)
      ao += double(earlier[i].weight[corner]) * double(before[earlier[i].pixel[corner]]);
    sum += std::abs(double(now[i]) - ao);
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

double mean_change(std::span<const std::vector<float>> ao,
                   std::span<const std::vector<EarlierPixels>> earlier) {
  double sum = 0;
  for (std::size_t f = 1; f < ao.size(); ++f) sum += change_between(ao[f], ao[f - 1], earlier[f - 1]);
  return ao.size() > 1 ? sum / double(ao.size() - 1) : 0;
}

double mean_step(const Path& path) {
  const TracedView& now = *path.frames.back();
  const std::uint32_t width = now.camera.width;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < now.depth.size(); ++i) {
    const EarlierPixels& earlier = path.earlier.back()[i];
    if (!earlier.seen()) continue;
    double x = 0, y = 0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      x += double(earlier.weight[corner]) * double(earlier.pixel[corner] % width);
      y += double(earlier.weight[corner]) * double(earlier.pixel[corner] / width);
    }
    sum += std::hypot(x - double(i % width), y - double(i / width));
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

double mse_where(std::span<const float> ao, const MeasuredView& view,
                 const std::function<bool(std::size_t)>& counts) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (!std::isfinite(view.view.depth[i]) || !counts(i)) continue;
    const double error = double(ao[i]) - double(view.truth[i]);
    sum += error * error;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

const SequenceError& error_of(const SequenceView& view, int taps, int frames) {
  for (const SequenceError& error : view.errors)
    if (error.taps == taps && error.frames == frames) return error;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "sequences: there is no row for %d taps and %d frames", taps,
                frames);
}

// Returns a column's value for one view and pass.
using Column = std::function<double(const SequenceView&, const SequenceError&)>;
struct NamedColumn {
  const char* name;
  Column value;
  bool of_disoccluded = false;
};

double flicker_of(const SequenceView& view, const SequenceError& error) {
  return error.change - error_of(view, 64, 1).change;
}

std::vector<NamedColumn> columns() {
  return {{"mse", [](const SequenceView&, const SequenceError& e) { return e.mse; }},
          {"disoccluded_mse", [](const SequenceView&, const SequenceError& e) { return e.disoccluded_mse; },
           true},
          {"path_change", [](const SequenceView&, const SequenceError& e) { return e.change; }},
          {"path_flicker", flicker_of}};
}

bool has_disoccluded(const SequenceView& view) {
  return view.disoccluded >= fewest_disoccluded;
}

Json source_row(std::span<const SequenceView> views, const std::string& source, std::size_t method) {
  Json row;
  for (const NamedColumn& column : columns()) {
    Mean mean;
    for (const SequenceView& view : views) {
      if (view.source != source) continue;
      const SequenceError& error = view.errors[method];
      if (row.empty())
        row = {{"method", error.frames > 1 ? "nnao_temporal" : "nnao"},
               {"taps", error.taps},
               {"frames", error.frames},
               {"scene", source}};
      if (column.of_disoccluded && !has_disoccluded(view)) continue;
      mean.add(column.value(view, error));
    }
    row[column.name] = mean_or_null(mean);
  }
  return row;
}

std::vector<std::string> mean_columns() {
  std::vector<std::string> names;
  for (const NamedColumn& column : columns()) names.emplace_back(column.name);
  return names;
}

// Describes a ratio of the errors of two passes, over all pixels or only over disoccluded pixels.
struct SequenceRatio {
  int taps, frames, over_taps, over_frames;
  bool disoccluded;
};

std::vector<SequenceRatio> measured_ratios() {
  std::vector<SequenceRatio> ratios{{9, 4, 32, 1, false}, {16, 4, 64, 1, false}};
  for (const int frames : {4, int(sequence_frames)})
    for (const int taps : measured_taps) ratios.push_back({taps, frames, taps, 1, false});
  for (const int frames : {4, int(sequence_frames)})
    for (const int taps : measured_taps) ratios.push_back({taps, frames, taps, 1, true});
  return ratios;
}

Json ratio_row(std::span<const SequenceView> views, const SequenceRatio& asked, std::uint64_t seed) {
  std::vector<ErrorPair> pairs;
  for (const SequenceView& view : views) {
    if (asked.disoccluded && !has_disoccluded(view)) continue;
    const SequenceError &error = error_of(view, asked.taps, asked.frames),
                        &over = error_of(view, asked.over_taps, asked.over_frames);
    pairs.push_back(asked.disoccluded ? ErrorPair{view.source, error.disoccluded_mse, over.disoccluded_mse}
                                      : ErrorPair{view.source, error.mse, over.mse});
  }
  Json row{{"taps", asked.taps},
           {"frames", asked.frames},
           {"over_taps", asked.over_taps},
           {"over_frames", asked.over_frames},
           {"pixels", asked.disoccluded ? "disoccluded" : "all"},
           {"views", pairs.size()}};
  if (pairs.empty()) return row;
  const RatioStatistics statistics = compare_errors(pairs, seed);
  Json sources = Json::object();
  for (const SourceRatio& source : statistics.sources) sources[source.source] = source.ratio;
  row["ratio"] = statistics.ratio;
  row["lower_95"] = statistics.lower_95;
  row["upper_95"] = statistics.upper_95;
  row["upper_95_sources"] = statistics.upper_95_sources;
  row["sources"] = sources;
  return row;
}

Json view_rows(std::span<const SequenceView> views) {
  Json rows = Json::array();
  for (const SequenceView& view : views)
    for (const SequenceError& error : view.errors)
      rows.push_back(
          {{"scene", view.scene},
           {"source", view.source},
           {"camera", view.camera},
           {"step_px", view.step_px},
           {"disoccluded_share", view.surfaces > 0 ? double(view.disoccluded) / double(view.surfaces) : 0.0},
           {"taps", error.taps},
           {"frames", error.frames},
           {"mse", error.mse},
           {"disoccluded_mse", error.disoccluded_mse},
           {"path_change", error.change},
           {"path_flicker", flicker_of(view, error)}});
  return rows;
}

std::string pass_words(const Json& taps, const Json& frames) {
  std::string text = taps.dump();
  text += frames == 1 ? " taps" : " taps, " + frames.dump() + " frames";
  return text;
}

std::string mean_table(const Json& rows) {
  std::string text =
      "| taps | frames | mse | disoccluded_mse | path_change | path_flicker |\n|---|---|---|---|---|---|\n";
  for (const Json& row : rows) {
    if (row["scene"] != "mean") continue;
    text.append("| ").append(row["taps"].dump()).append(" | ").append(row["frames"].dump());
    text.append(" | ").append(table_number(row, "mse", "%.5f"));
    text.append(" | ").append(table_number(row, "disoccluded_mse", "%.5f"));
    text.append(" | ").append(table_number(row, "path_change", "%.4f"));
    text.append(" | ").append(table_number(row, "path_flicker", "%.4f")).append(" |\n");
  }
  return text;
}

std::string worst_source(const Json& sources) {
  std::string name;
  for (const auto& [source, ratio] : sources.items())
    if (name.empty() || ratio > sources[name]) name = source;
  return name + " " + table_number(sources, name.c_str(), "%.2f");
}

std::string ratio_table(const Json& ratios) {
  std::string text =
      "| mean over frames / one frame | pixels | ratio | 90 % of draws | worst source |\n"
      "|---|---|---|---|---|\n";
  for (const Json& row : ratios) {
    text.append("| ").append(pass_words(row["taps"], row["frames"])).append(" / ");
    text.append(pass_words(row["over_taps"], row["over_frames"])).append(" | ");
    text.append(row["pixels"].get<std::string>()).append(" | ");
    if (!row.contains("ratio")) {
      text += "- | - | - |\n";
      continue;
    }
    text.append(table_number(row, "ratio", "%.3f"))
        .append(" | ")
        .append(table_number(row, "lower_95", "%.3f"));
    text.append(" to ").append(table_number(row, "upper_95", "%.3f")).append(" | ");
    text.append(worst_source(row["sources"])).append(" |\n");
  }
  return text;
}

}  // namespace

SequenceView measure_sequence(platform::Context& context, const MeasuredView& view, AoRequest request) {
  const GladGLContext& gl = context.gl();
  const int width = int(view.view.camera.width), height = int(view.view.camera.height);
  request.radius = view.radius;
  const Path path = path_of(view);
  if (path.frames.size() != sequence_frames)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "sequences: the path has %zu frames, need %zu",
                  path.frames.size(), sequence_frames);
  std::deque<GpuView> images;
  for (const TracedView* frame : path.frames) images.emplace_back(gl, *frame);

  SequenceView measured{view.scene, view.source, view.camera, mean_step(path), 0, 0, {}};
  const std::vector<EarlierPixels>& before = path.earlier.back();
  const auto disoccluded = [&](std::size_t i) { return !before[i].seen(); };
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!std::isfinite(view.view.depth[i])) continue;
    measured.surfaces += 1;
    measured.disoccluded += disoccluded(i);
  }

  // Makes a new pass for each path, because the noise pattern of a frame depends on how many frames the pass
  // has drawn before.
  const NookGl nook_gl(context);
  const auto add = [&](const NetworkForm& form, std::size_t first, int frames) {
    NetworkPass pass(nook_gl, width, height, form, {}, request.blur_sharpness);
    std::vector<std::vector<float>> ao;
    for (std::size_t f = first; f < images.size(); ++f) {
      const Mat3x4& world_from_view = path.frames[f]->camera.world_from_view;
      ao.push_back(
          read_red(gl, pass.draw(images[f], request, true, world_from_view, f == first), width, height));
    }
    SequenceError error{form.taps, frames, 0, 0, 0};
    error.mse = mse_where(ao.back(), view, [](std::size_t) { return true; });
    error.disoccluded_mse = mse_where(ao.back(), view, disoccluded);
    error.change = mean_change(ao, std::span(path.earlier).subspan(first));
    measured.errors.push_back(error);
  };
  for (const int taps : measured_taps) add({taps}, 0, 1);
  for (const std::size_t frames : measured_paths)
    for (const int taps : measured_taps) {
      NetworkForm form{taps};
      form.temporal_frames = longest_mean;
      add(form, images.size() - frames, int(frames));
    }
  return measured;
}

Json sequence_report(std::span<const SequenceView> views, std::uint64_t seed) {
  Json rows = Json::array(), ratios = Json::array();
  for (std::size_t method = 0; method < views.front().errors.size(); ++method) {
    std::vector<Json> of_sources;
    for (const std::string& source : distinct_names(views, &SequenceView::source))
      of_sources.push_back(source_row(views, source, method));
    for (const Json& row : of_sources) rows.push_back(row);
    rows.push_back(mean_row(of_sources, mean_columns()));
    rows.back()["scene"] = "mean";
  }
  for (const SequenceRatio& ratio : measured_ratios()) ratios.push_back(ratio_row(views, ratio, seed));
  return {{"rows", rows}, {"ratios", ratios}, {"views", view_rows(views)}};
}

std::string sequence_markdown(const Json& report) {
  return mean_table(report["rows"]) + "\n" + ratio_table(report["ratios"]);
}

}  // namespace nook::lab
