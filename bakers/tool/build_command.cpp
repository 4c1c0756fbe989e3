// `nook build` runs `nook plan`, and then Ninja for the bakes that have to run.
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>

#include "bakers/tool/child_process.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/plan/planning.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

namespace fs = std::filesystem;

struct Options {
  plan::PlanOptions plan;
  unsigned jobs = 0;
};

// Ninja prints the text of this variable in front of each status line. We set it so that it contains the
// number of finished edges and the number of all edges.
constexpr const char* status_variable = "NINJA_STATUS";
constexpr const char* status_form = "@nook %f %t@ ";
constexpr const char* failed_line = "FAILED: ";

fs::path find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  const std::string folders = path ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const fs::path program = fs::path(folders.substr(begin, end - begin)) / name;
    std::error_code error;
    if (end > begin && fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0)
      return program;
    begin = end + 1;
  }
  throw ToolError(exit_other, "build: there is no program " + name +
                                  " on the PATH; install it (Debian: apt install ninja-build), or run the "
                                  "lines of tasks.txt from nook plan in another way");
}

// Shows the output of Ninja. Its counts become one progress line. Everything else is shown unchanged.
class NinjaOutput {
 public:
  explicit NinjaOutput(bool quiet) : bar_(quiet) {}

  void add(const char* text, std::size_t size) {
    rest_.append(text, size);
    std::size_t end;
    while ((end = rest_.find('\n')) != std::string::npos) {
      line(rest_.substr(0, end));
      rest_.erase(0, end + 1);
    }
  }
  void finish() {
    if (!rest_.empty()) line(rest_);
    rest_.clear();
  }
  std::size_t failed() const { return failed_; }

 private:
  // A status line begins with the counts. The name that follows them is already in the log, so it is not
  // shown.
  void line(const std::string& text) {
    std::size_t done = 0, total = 0;
    if (std::sscanf(text.c_str(), "@nook %zu %zu@", &done, &total) == 2) {
      done_ = done;
      total_ = total;
      show();
    } else if (text.starts_with(failed_line)) {
      ++failed_;
      std::fprintf(stderr, "%s\n", platform::printable(text).c_str());
    } else if (!text.starts_with("cd ") && !text.starts_with("ninja: ")) {
      std::fprintf(stderr, "%s\n", platform::printable(text).c_str());
    }
  }
  // A new label starts a new line. This happens only after a failure, which has interrupted the line anyway.
  void show() {
    const std::string failed = failed_ > 0 ? ", " + std::to_string(failed_) + " failed" : "";
    bar_.show("build" + failed, "bakes", done_, total_);
  }

  platform::ProgressBar bar_;
  std::string rest_;
  std::size_t done_ = 0, total_ = 0, failed_ = 0;
};

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw ToolError(exit_other, std::string("build: cannot make a pipe to Ninja (") + std::strerror(errno) +
                                    "); end other programs");
  return ends;
}

int run_ninja(const fs::path& program, const std::vector<std::string>& arguments, NinjaOutput& output) {
  const std::array<int, 2> ends = make_pipe();
  setenv(status_variable, status_form, 1);
  const int child = start_child(program.c_str(), arguments, ends[1], -1);
  close(ends[1]);
  bool told = false;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t size = read(ends[0], buffer.data(), buffer.size());
    if (size > 0) output.add(buffer.data(), std::size_t(size));
    if (size == 0 || (size < 0 && errno != EINTR)) break;
    pass_on_interrupt(child, told);
  }
  close(ends[0]);
  output.finish();
  return wait_for_child(child);
}

void run(const Options& options) {
  const fs::path ninja = find_program("ninja");
  const plan::PlanResult planned = plan::make_plan(options.plan);
  if (planned.to_run == 0) return;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const std::vector<std::string> arguments{"ninja",
                                           "-C",
                                           planned.build.string(),
                                           "-k",
                                           "0",
                                           "-j",
                                           std::to_string(options.jobs > 0 ? options.jobs : cores)};
  NinjaOutput output(options.plan.quiet);
  const int code = run_ninja(ninja, arguments, output);
  if (code == 0) return;
  std::fprintf(
      stderr,
      "nook: build: %zu of %zu bakes failed, and others that need them did not run; the logs are in %s\n",
      output.failed(), planned.to_run, platform::printable((planned.build / "logs").string()).c_str());
  throw CommandEnd(exit_other);
}

}  // namespace

void add_build(Command tool) {
  const Command command = tool.add_subcommand(
      "build",
      "bake the assets of a project that have changed.\nThis command makes the same plan as `nook plan`, and "
      "runs its bakes with Ninja. If a bake fails, the other bakes still run, and the exit code is 1.");
  const auto options = std::make_shared<Options>();
  plan::add_plan_options(command, options->plan);
  command
      .add_option("-j,--jobs", options->jobs,
                  "number of bakes that run at the same time; 0 means one bake per core")
      .check(in_range(0, 1024))
      .capture_default_str();
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
