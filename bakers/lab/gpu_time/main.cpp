// nook_gpu_time: measures the time of Nook's passes on this machine's GPU in milliseconds. It also measures
// the methods that the documents compare the screen pass with.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/lab/gpu_time/timed_rows.h"
#include "platform/output_file.h"
#include "platform/standard_streams.h"

namespace {

using namespace nook::lab;
using namespace nook::measure;
namespace fs = std::filesystem;

constexpr int exit_bad_arguments = 2, exit_failed = 3;

struct Options {
  std::string context = "egl", only;
  int width = 1920, height = 1080, batches = 7;
  double batch_ms = 20;
  fs::path model, report;
  std::vector<fs::path> materials;
};

nlohmann::json json_of(const std::vector<TimedRow>& rows) {
  nlohmann::json all = nlohmann::json::array();
  for (const TimedRow& row : rows)
    all.push_back({{"name", row.name},
                   {"gpu_ms", row.time.gpu_ms},
                   {"slowest", row.time.slowest},
                   {"cpu_ms", row.time.cpu_ms}});
  return all;
}

void print(const TimedRow& row) {
  std::printf("| %s | %.4f | %.2f | %.4f |\n", row.name.c_str(), row.time.gpu_ms, row.time.slowest,
              row.time.cpu_ms);
  std::fflush(stdout);
}

int time_all(const Options& options) {
  // Opens the output before the work begins, so that an error is reported early.
  std::optional<platform::OutputFile> file;
  if (!options.report.empty()) file.emplace(options.report);
  platform::ContextRequest request;
  request.kind = options.context;
  request.width = options.width;
  request.height = options.height;
  const std::unique_ptr<platform::Context> context = platform::create_context(request);
  const NookGl nook(*context);
  const GpuClock clock(context->gl(), options.batches, options.batch_ms);
  const Timing timing{
      *context,       nook,
      clock,          options.width,
      options.height, [&](const std::string& name) {
                        return name.find(options.only) != std::string::npos; }};
  std::printf("OpenGL %s on %s, %d x %d\n\n", context->version().c_str(), context->renderer().c_str(),
              options.width, options.height);
  std::printf("| what | GPU, ms | slowest / median | CPU, ms |\n|---|---|---|---|\n");
  std::vector<TimedRow> rows;
  const auto take = [&](std::vector<TimedRow> more) {
    for (TimedRow& row : more) {
      print(row);
      rows.push_back(std::move(row));
    }
  };
  take(time_screen(timing));
  if (!options.model.empty()) {
    take(time_characters(timing, options.model));
    take(time_world(timing, options.model));
  }
  take(time_materials(timing, options.materials));
  take(time_probes(timing));
  if (file) {
    const nlohmann::json report = {{"version", context->version()}, {"renderer", context->renderer()},
                                   {"width", options.width},        {"height", options.height},
                                   {"batches", options.batches},    {"rows", json_of(rows)}};
    file->commit(report.dump(2) + "\n");
  }
  return 0;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App tool(
      "Measures the times of Nook's passes on the GPU, in milliseconds between two OpenGL time stamps.\nExit "
      "codes: 0 success, 2 bad arguments, 3 any other error.",
      "nook_gpu_time");
  tool.add_option(
      "--context", options.context,
      std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds());
  tool.add_option("--width", options.width, "width of the picture in pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  tool.add_option("--height", options.height, "height of the picture in pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  tool.add_option("--batches", options.batches,
                  "number of batches to run. The result is the median of their times")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  tool.add_option("--batch-ms", options.batch_ms, "length of a batch in milliseconds")
      ->check(CLI::Range(0.0, 10000.0))
      ->capture_default_str();
  tool.add_option(
          "--model", options.model,
          "also measure characters and the world pass, with this baked model of a character, a .nook file")
      ->check(CLI::ExistingFile);
  tool.add_option("--material", options.materials, "also measure these materials, .nook files")
      ->check(CLI::ExistingFile);
  tool.add_option("--only", options.only, "measure only rows whose name contains this text");
  tool.add_option("--report", options.report, "write the numbers to this JSON file");
  try {
    tool.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return tool.exit(error) == 0 ? 0 : exit_bad_arguments;
  }
  return time_all(options);
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_streams();
  try {
    return code_after_output(run(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nook_gpu_time: %s\n", error.what());
    return exit_failed;
  }
}
