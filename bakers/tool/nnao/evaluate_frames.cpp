#include "bakers/tool/nnao/evaluate_frames.h"

#include <algorithm>
#include <cstdio>

#include "bakers/measure/nnao/frame_pictures.h"
#include "bakers/measure/nnao/frame_report.h"
#include "bakers/tool/image_folder.h"
#include "bakers/tool/input_file.h"
#include "bakers/tool/interrupt.h"
#include "platform/progress_bar.h"
#include "sdk/src/nnao/recording_file.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::ordered_json;
using nook::nnao::Recording;

// The file's name without .nook; with a number where an earlier frame has it already.
std::string frame_name(const std::filesystem::path& file, const std::vector<std::string>& taken) {
  const std::string stem = as_file_name(file.stem().string());
  std::string name = stem;
  for (int number = 2; std::ranges::find(taken, name) != taken.end(); ++number) {
    name = stem;
    name.append("_").append(std::to_string(number));
  }
  return name;
}

void write_pictures(const std::filesystem::path& folder, const std::string& frame,
                    const bake::nnao::TracedView& view, std::span<const FrameRow> rows) {
  const std::vector<NamedPicture> pictures = frame_pictures(view, rows);
  for (const NamedPicture& picture : pictures)
    platform::write_image(folder / (frame + "_" + picture.name + ".png"), picture.image);
  platform::write_image(folder / (frame + ".png"), picture_sheet(pictures));
}

void warn_about_network(const std::string& frame, const Recording& recording) {
  if (!nook::nnao::recorded_network(recording).readable)
    std::fprintf(stderr,
                 "%s: its network is not one that this version evaluates; the embedded network takes its "
                 "place\n",
                 frame.c_str());
}

Json frame_summary(const std::string& frame, const Recording& recording) {
  return {{"frame", frame},
          {"radius", recording.frame.radius},
          {"renderer", std::string(recording.renderer)},
          {"driver_version", std::string(recording.driver_version)},
          {"note", std::string(recording.note)}};
}

}  // namespace

Json evaluate_frames(platform::Context& context, const FrameWords& words) {
  const NookGl nook(context);
  platform::ProgressBar bar(words.quiet);
  std::vector<std::string> names;
  Json report, rows = Json::array(), frames = Json::array();
  for (const std::filesystem::path& file : words.files) {
    const std::vector<std::byte> bytes = read_file(file);
    const Recording recording = naming_file(file, [&] { return nook::nnao::read_recording(bytes); });
    names.push_back(frame_name(file, names));
    const std::string& name = names.back();
    warn_about_network(name, recording);
    naming_file(file, [&] {
      FrameReplay replay(context.gl(), nook, recording);
      const std::vector<FrameRow> drawn = compare_frame(
          replay, recording, words.methods, words.network, [&](std::size_t done, std::size_t total) {
            bar.show("replaying " + name, "methods", done, total);
            return !interrupted();
          });
      if (drawn.empty() || drawn.back().method == recorded_name)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: none can replay this frame");
      for (const Json& row : frame_rows(name, recording, drawn)) rows.push_back(row);
      if (!words.images.empty()) write_pictures(words.images, name, replay.view(), drawn);
    });
    frames.push_back(frame_summary(name, recording));
  }
  for (const Json& row : frame_mean_rows(rows)) rows.push_back(row);
  report["rows"] = std::move(rows);
  report["frames"] = std::move(frames);
  report["opengl"] = context.version();
  report["gpu"] = context.renderer();
  return report;
}

}  // namespace nook::tool
