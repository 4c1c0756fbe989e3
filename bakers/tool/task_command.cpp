// `nook task` runs one bake for a farm, with a log and with retries.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>

#include "bakers/tool/child_process.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/pinned_process.h"
#include "bakers/tool/plan/bake_words.h"
#include "platform/printable.h"
#include "platform/stopwatch.h"

namespace nook::tool {
namespace {

struct Options {
  std::filesystem::path log;
  unsigned retries = 2;
  std::vector<std::string> words;
};

constexpr std::size_t shown_lines = 20;
// A short pause before another attempt, because a full disk or a lost mount may recover.
constexpr unsigned pause_s = 1;

// The log file. It is written line by line to its final path, so that it can be read while the bake runs, and
// after the bake was killed. Without a log file, the bake writes to the streams of this program.
class Log {
 public:
  explicit Log(const std::filesystem::path& path) : path_(path) {
    if (path.empty()) return;
    std::error_code ignored;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
    descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw ToolError(exit_other, "--log: " + path.string() + " cannot be written (" + std::strerror(errno) +
                                      "); choose another place");
  }
  ~Log() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  int descriptor() const { return descriptor_; }

  // On a full disk, lines of the log are lost, but the bake continues.
  void note(const std::string& text) const {
    const std::string line = "nook task: " + platform::printable(text) + "\n";
    if (descriptor_ >= 0 && write(descriptor_, line.data(), line.size()) < 0) return;
  }

  void show_end(const std::string& command, int code) const {
    std::fprintf(stderr, "nook task: exit code %d of: %s\n", code, platform::printable(command).c_str());
    if (descriptor_ < 0) return;
    std::ifstream file(path_, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::fprintf(stderr, "%s: its last lines:\n%s", platform::printable(path_.string()).c_str(),
                 platform::printable_lines(last_lines(text, shown_lines)).c_str());
  }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

std::string place_and_time() {
  char host[256] = "", time[64] = "";
  if (gethostname(host, sizeof host - 1) != 0) host[0] = 0;
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::strftime(time, sizeof time, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
  return std::string(host) + ", " + time;
}

// Returns true if another attempt with the same arguments and inputs would fail in the same way.
bool is_final(int code) {
  return code == exit_done || code == exit_bad_arguments || code == exit_bad_input || code == exit_bad_result;
}

int attempt(const Options& options, const Log& log, const std::string& command, unsigned number) {
  log.note("attempt " + std::to_string(number + 1) + " of " + std::to_string(options.retries + 1) + " on " +
           place_and_time() + ": " + command);
  const platform::Stopwatch watch;
  std::vector<std::string> arguments{"nook"};
  arguments.insert(arguments.end(), options.words.begin(), options.words.end());
  const int code =
      wait_for_child(start_child("/proc/self/exe", arguments, log.descriptor(), log.descriptor()));
  char text[80];
  std::snprintf(text, sizeof text, "exit code %d after %.2f s", code, watch.seconds());
  log.note(text);
  return code;
}

void run(const Options& options) {
  if (options.words.front() == "task" || options.words.front() == "build")
    throw ToolError(exit_bad_arguments, "task: cannot run a command that runs other commands (got " +
                                            options.words.front() + "); give a command such as bake");
  const Log log(options.log);
  std::string command = "nook";
  for (const std::string& word : options.words) command += " " + plan::quoted(word);
  pin_children(options.words);
  int code = exit_done;
  for (unsigned number = 0; number <= options.retries; ++number) {
    code = attempt(options, log, command, number);
    if (is_final(code) || interrupted()) break;
    if (number < options.retries) sleep(pause_s);
  }
  if (code == exit_done) return;
  log.show_end(command, code);
  throw CommandEnd(code);
}

}  // namespace

void add_task(Command tool) {
  const Command command = tool.add_subcommand(
      "task",
      "run another command of nook, with a log file and retries, for bake farms.\nIf the command fails, it "
      "runs again. It does not run again if its exit code is 2, 3 or 4, because the same arguments and "
      "inputs would then fail again. The exit code of `nook task` is the exit code of the last run.");
  const auto options = std::make_shared<Options>();
  command
      .add_option("command", options->words,
                  "the command to run and its arguments; write -- before them, as in: nook task -- bake "
                  "character HERO.glb -o HERO.nook")
      .required();
  command.add_option("--log", options->log,
                     "write everything that the command prints to this file, line by line. An existing file "
                     "is replaced. Default: no log file");
  command.add_option("--retries", options->retries, "number of times to run the command again if it fails")
      .check(in_range(0, 100))
      .capture_default_str();
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
