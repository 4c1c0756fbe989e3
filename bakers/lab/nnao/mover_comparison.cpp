#include "bakers/lab/nnao/mover_comparison.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "bakers/lab/nnao/row_statistics.h"
#include "bakers/measure/nnao/network_pass.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

constexpr int measured_taps[] = {9, 16, 32};

struct NamedPart {
  MoverPart part;
  const char* name;
};
constexpr NamedPart named_parts[] = {{MoverPart::mover, "mover"},
                                     {MoverPart::uncovered, "uncovered"},
                                     {MoverPart::beside, "beside"},
                                     {MoverPart::elsewhere, "elsewhere"}};

// The images of all frames of a view, on the GPU.
struct MoverImages {
  MoverImages(const GladGLContext& gl, const MoverView& view) {
    const MeasuredView& measured = view.measured;
    for (const bake::nnao::TracedView& frame : measured.path) frames.emplace_back(gl, frame);
    frames.emplace_back(gl, measured.view);
    for (const std::vector<float>& of_frame : view.motion)
      motion.emplace_back(gl, GL_RG32F, GL_RG, frames.back().width, frames.back().height, of_frame.data());
  }

  std::deque<GpuView> frames;
  std::deque<GpuImage> motion;
};

// Draws all frames and returns the AO of the last one.
std::vector<float> draw(const GladGLContext& gl, const NookGl& nook_gl, const MoverView& view,
                        const MoverImages& images, const AoRequest& request, int taps, MoverPass used) {
  const std::size_t count = images.frames.size();
  const auto camera = [&](std::size_t f) -> const bake::nnao::Camera& {
    return f + 1 < count ? view.measured.path[f].camera : view.measured.view.camera;
  };
  const int width = images.frames.back().width, height = images.frames.back().height;
  NetworkForm form{taps};
  if (used != MoverPass::single) form.temporal_frames = int(mover_frames);
  NetworkPass pass(nook_gl, width, height, form, {}, request.blur_sharpness);
  GLuint texture = 0;
  for (std::size_t f = 0; f < count; ++f) {
    texture = pass.draw(images.frames[f], request, true, camera(f).world_from_view, f == 0,
                        used == MoverPass::vectors ? images.motion[f].texture() : 0);
  }
  return read_red(gl, texture, width, height);
}

MoverError error_of(const MoverView& view, const std::vector<float>& ao, int taps, MoverPass pass) {
  std::array<Mean, mover_part_count> squares, differences;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    const auto part = std::size_t(view.part[i]);
    const double difference = double(ao[i]) - double(view.measured.truth[i]);
    squares[part].add(difference * difference);
    differences[part].add(difference);
  }
  MoverError error{taps, pass, {}, {}};
  for (std::size_t p = 0; p < mover_part_count; ++p) {
    error.mse[p] = squares[p].value();
    error.bias[p] = differences[p].value();
  }
  return error;
}

bool counts(const MeasuredMover& mover, MoverPart part) {
  return mover.pixels[std::size_t(part)] >= fewest_part_pixels;
}

Json character_row(std::span<const MeasuredMover> movers, const std::string& character, std::size_t method) {
  const MoverError& first = movers.front().errors[method];
  Json row{{"taps", first.taps}, {"pass", mover_pass_name(first.pass)}, {"character", character}};
  for (const auto& [part, name] : named_parts) {
    Mean mse, bias;
    for (const MeasuredMover& mover : movers) {
      if (mover.character != character || !counts(mover, part)) continue;
      mse.add(mover.errors[method].mse[std::size_t(part)]);
      bias.add(mover.errors[method].bias[std::size_t(part)]);
    }
    const std::string key = name;
    row[key + "_mse"] = mean_or_null(mse);
    row[key + "_bias"] = mean_or_null(bias);
  }
  return row;
}

std::vector<std::string> mean_columns() {
  std::vector<std::string> columns;
  for (const NamedPart& part : named_parts)
    for (const char* end : {"_mse", "_bias"}) columns.push_back(std::string(part.name) + end);
  return columns;
}

const MoverError& single_of(const MeasuredMover& mover, int taps) {
  const auto found = std::ranges::find_if(mover.errors, [&](const MoverError& error) {
    return error.taps == taps && error.pass == MoverPass::single;
  });
  if (found == mover.errors.end())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "movers: there is no row for a single frame with %d taps",
                  taps);
  return *found;
}

Json ratio_row(std::span<const MeasuredMover> movers, std::size_t method, NamedPart part,
               std::uint64_t seed) {
  std::vector<ErrorPair> pairs;
  double worst = 0;
  std::string worst_view;
  for (const MeasuredMover& mover : movers) {
    if (!counts(mover, part.part)) continue;
    const MoverError& error = mover.errors[method];
    const auto p = std::size_t(part.part);
    pairs.push_back({mover.character, error.mse[p], single_of(mover, error.taps).mse[p]});
    if (pairs.back().error <= worst * pairs.back().reference) continue;
    worst = pairs.back().error / pairs.back().reference;
    worst_view = mover.character + " " + mover.shot + (mover.camera_moves ? ", camera moves" : "");
  }
  const MoverError& first = movers.front().errors[method];
  Json row{{"taps", first.taps},
           {"pass", mover_pass_name(first.pass)},
           {"part", part.name},
           {"views", pairs.size()}};
  if (pairs.empty()) return row;
  const RatioStatistics statistics = compare_errors(pairs, seed);
  row["ratio"] = statistics.ratio;
  row["lower_95"] = statistics.lower_95;
  row["upper_95"] = statistics.upper_95;
  row["worst"] = worst;
  row["worst_view"] = worst_view;
  return row;
}

Json view_rows(std::span<const MeasuredMover> movers) {
  Json rows = Json::array();
  for (const MeasuredMover& mover : movers)
    for (const MoverError& error : mover.errors) {
      Json row{{"character", mover.character},
               {"shot", mover.shot},
               {"camera_moves", mover.camera_moves},
               {"taps", error.taps},
               {"pass", mover_pass_name(error.pass)}};
      for (const auto& [part, name] : named_parts) {
        const std::string key = name;
        row[key + "_pixels"] = mover.pixels[std::size_t(part)];
        row[key + "_mse"] = error.mse[std::size_t(part)];
        row[key + "_bias"] = error.bias[std::size_t(part)];
      }
      rows.push_back(row);
    }
  return rows;
}

}  // namespace

const char* mover_pass_name(MoverPass pass) {
  switch (pass) {
    case MoverPass::single:
      return "one frame";
    case MoverPass::vectors:
      return "8 frames, motion vectors";
    case MoverPass::cameras:
      return "8 frames, camera alone";
  }
  return "";
}

MeasuredMover measure_mover(platform::Context& context, const MoverView& view, AoRequest request,
                            std::vector<std::vector<float>>* images) {
  if (view.motion.size() != mover_frames)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "movers: got %zu frames, need %zu", view.motion.size(),
                  mover_frames);
  const GladGLContext& gl = context.gl();
  request.radius = view.measured.radius;
  MeasuredMover measured;
  for (const MoverPart part : view.part) ++measured.pixels[std::size_t(part)];
  const NookGl nook_gl(context);
  const MoverImages on_gpu(gl, view);
  for (const int taps : measured_taps)
    for (const MoverPass pass : mover_passes) {
      std::vector<float> ao = draw(gl, nook_gl, view, on_gpu, request, taps, pass);
      measured.errors.push_back(error_of(view, ao, taps, pass));
      if (images && taps == measured_taps[0]) images->push_back(std::move(ao));
    }
  return measured;
}

Json mover_report(std::span<const MeasuredMover> movers, std::uint64_t seed) {
  Json report;
  report["rows"] = Json::array();
  report["ratios"] = Json::array();
  const std::vector<std::string> characters = distinct_names(movers, &MeasuredMover::character);
  for (std::size_t method = 0; method < movers.front().errors.size(); ++method) {
    std::vector<Json> rows;
    for (const std::string& character : characters) rows.push_back(character_row(movers, character, method));
    rows.push_back(mean_row(rows, mean_columns()));
    rows.back()["character"] = "mean";
    for (const Json& row : rows) report["rows"].push_back(row);
    if (movers.front().errors[method].pass == MoverPass::single) continue;
    for (const NamedPart& part : named_parts)
      report["ratios"].push_back(ratio_row(movers, method, part, seed));
  }
  report["views"] = view_rows(movers);
  return report;
}

std::string mover_markdown(const Json& report) {
  std::string text =
      "| taps | pass | mover, mse | uncovered | beside | elsewhere | mover, bias | uncovered | beside |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Json& row : report["rows"]) {
    if (row["character"] != "mean") continue;
    text.append("| ").append(row["taps"].dump()).append(" | ").append(row["pass"].get<std::string>());
    for (const char* key : {"mover_mse", "uncovered_mse", "beside_mse", "elsewhere_mse"})
      text.append(" | ").append(table_number(row, key, "%.5f"));
    for (const char* key : {"mover_bias", "uncovered_bias", "beside_bias"})
      text.append(" | ").append(table_number(row, key, "%.3f"));
    text += " |\n";
  }
  text +=
      "\n| taps | pass / one frame | pixels | ratio of mse | 90 % of draws | worst view |\n"
      "|---|---|---|---|---|---|\n";
  for (const Json& row : report["ratios"]) {
    text.append("| ").append(row["taps"].dump()).append(" | ").append(row["pass"].get<std::string>());
    text.append(" | ")
        .append(row["part"].get<std::string>())
        .append(" | ")
        .append(table_number(row, "ratio", "%.3f"));
    text.append(" | ").append(table_number(row, "lower_95", "%.3f")).append(" to ");
    text.append(table_number(row, "upper_95", "%.3f")).append(" | ");
    text.append(row.value("worst_view", "-"))
        .append(" ")
        .append(table_number(row, "worst", "%.2f"))
        .append(" |\n");
  }
  return text;
}

}  // namespace nook::lab
