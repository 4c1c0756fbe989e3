// `nook evaluate nnao` draws recorded frames of the screen-space pass again. It uses OpenGL without a
// display.
#include "bakers/tool/evaluate_nnao.h"

#include <algorithm>
#include <cstdio>

#include "bakers/measure/nnao/frame_pictures.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"
#include "sdk/src/nnao/recording_file.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::ordered_json;
using nook::nnao::Recording;

// Returns the name of the file without .nook. If an earlier frame already has this name, appends a number.
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
                 "%s: this version of Nook cannot evaluate the network that was recorded; the network that "
                 "is built into Nook is used instead\n",
                 frame.c_str());
}

Json frame_summary(const std::string& frame, const Recording& recording) {
  return {{"frame", frame},
          {"radius", recording.frame.radius},
          {"renderer", std::string(recording.renderer)},
          {"driver_version", std::string(recording.driver_version)},
          {"note", std::string(recording.note)}};
}

struct Options {
  CommonOptions common;
  std::vector<std::filesystem::path> frames;
  std::vector<std::string> methods;
  std::filesystem::path network, images;
};

void run(const Options& options) {
  CommandFiles files{{{"--network", options.network}}, {}, options.images};
  for (const std::filesystem::path& frame : options.frames) files.inputs.push_back({"--frame", frame});
  run_evaluation(options.common, files, [&] {
    const Networks networks = read_networks(options.network);
    const auto context = make_context();
    return evaluate_frames(
        *context, {options.frames, options.methods, networks.file, options.images, options.common.quiet},
        nullptr);
  });
}

}  // namespace

Networks read_networks(const std::filesystem::path& file) {
  Networks networks;
  networks.embedded = nook::nnao::read_network(nook::nnao::default_network_file());
  if (file.empty()) return networks;
  networks.file = read_file(file);
  networks.other = naming_file(file, [&] { return nook::nnao::read_network(networks.file); });
  return networks;
}

std::unique_ptr<platform::Context> make_context() {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  return platform::create_context(request);
}

Json evaluate_frames(platform::Context& context, const FrameWords& words, const FrameMethods& further) {
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
      const auto methods = further ? further(context.gl()) : std::vector<FrameMethod>();
      const auto show = [&](std::size_t done, std::size_t total) {
        bar.show("replaying " + name, "methods", done, total);
        return !interrupted();
      };
      const std::vector<FrameRow> drawn =
          compare_frame(replay, recording, words.methods, words.network, show, methods);
      if (drawn.empty() || drawn.back().method == recorded_name)
        throw ToolError(exit_bad_arguments,
                        "evaluate nnao: --methods: none of the methods can draw this frame");
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

void add_evaluate_nnao(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "nnao",
      "measure recorded frames of the screen-space pass (NNAO).\nThe command draws the AO of each frame "
      "again: with the recorded settings (replayed), and with the presets fast, default and best. It "
      "compares the results with the exact AO of the recorded depth buffer (oracle). `nook-lab evaluate "
      "nnao` measures scenes.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_input("--frame", o.frames,
                 "measure this recorded frame, a file that nook_nnao_record wrote. You can repeat the option")
      .required()
      .type_name("FILE.nook");
  std::vector<std::string> names{"all", file_name};
  for (const std::string& name : frame_method_names()) names.push_back(name);
  for (const Oracle oracle : all_oracles) names.push_back(oracle_name(oracle));
  command
      .add_option(
          "--methods", o.methods,
          "draw only these methods; separate them by commas. Each is NAME, or NAME:TAPS for a number of "
          "taps. Default: replayed, fast, default, best and oracle, and nnao_file if you give --network")
      .delimiter(',')
      .check([names](const std::string& text) { return one_of(names)(text.substr(0, text.find(':'))); });
  command.add_input(
      "--network", o.network,
      "also draw with this network, a file that `nook train nnao` wrote. Its method is called nnao_file");
  command.add_option("--images", o.images, "write PNG files of each frame into this folder");
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
