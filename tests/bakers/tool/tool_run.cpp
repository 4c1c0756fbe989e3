#include "tests/bakers/tool/tool_run.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace {

void redirect(int descriptor, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

}  // namespace

TestFolder::TestFolder() {
  std::string name =
      (std::filesystem::temp_directory_path() / "nook tool XXXXXX").string();  // with spaces: users have them
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
  folder_ = name;
}

TestFolder::~TestFolder() {
  std::filesystem::remove_all(folder_);
}

std::vector<std::string> TestFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name != "stdout" && name != "stderr") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

ToolRun TestFolder::run(const std::vector<std::string>& arguments) const {
  return finish(start(arguments));
}

ToolRun TestFolder::run_program(const std::string& program, const std::vector<std::string>& arguments) const {
  return finish(start_program(program, arguments));
}

ToolRun TestFolder::run_and_signal(const std::vector<std::string>& arguments, int signal,
                                   const std::string& text) const {
  const int child = start(arguments);
  bool over = false;
  while (!over && read_text(path("stderr")).find(text) == std::string::npos) {
    usleep(2000);
    siginfo_t info{};
    over = waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == child;
  }
  if (!over) kill(child, signal);
  return finish(child);
}

int TestFolder::start(const std::vector<std::string>& arguments) const {
  return start_program(NOOK_TOOL, arguments);
}

int TestFolder::start_program(const std::string& program, const std::vector<std::string>& arguments) const {
  // The output of an earlier run must not be taken for this one's.
  write_text(path("stdout"), "");
  write_text(path("stderr"), "");
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  const std::string out = path("stdout"), error = path("stderr");
  const pid_t child = fork();
  if (child == 0) {
    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, error);
    execv(raw[0], raw.data());
    _exit(127);
  }
  return child;
}

ToolRun TestFolder::finish(int child) const {
  int status = 0;
  waitpid(child, &status, 0);
  ToolRun run;
  // A tool that a signal killed did not stop by itself; no exit code of the tool's own is that large.
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = read_text(path("stdout"));
  run.error = read_text(path("stderr"));
  return run;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
}
