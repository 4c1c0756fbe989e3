#include "bakers/tool/child_process.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "bakers/tool/command_end.h"

namespace nook::tool {
namespace {

constexpr int exit_not_started = 127;  // the exit code that shells use if a program cannot be started

// Replaces the forked process by the program. Only makes calls that are allowed between fork and exec.
[[noreturn]] void become(const char* program, char* const* arguments, int output, int error, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(exit_not_started);  // the parent has already ended
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  if (output >= 0) dup2(output, STDOUT_FILENO);
  if (error >= 0) dup2(error, STDERR_FILENO);
  execv(program, arguments);
  _exit(exit_not_started);
}

}  // namespace

int start_child(const char* program, const std::vector<std::string>& arguments, int output, int error) {
  std::vector<std::string> words = arguments;
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(program, raw.data(), output, error, parent);
  if (child < 0)
    throw ToolError(exit_other, std::string(program) + ": cannot be started (" + std::strerror(errno) +
                                    "); end other programs");
  return child;
}

void pass_on_interrupt(int child, bool& told) {
  if (!interrupted() || told) return;
  kill(child, SIGTERM);
  told = true;
}

int wait_for_child(int child) {
  int status = 0;
  bool told = false;
  for (;;) {
    pass_on_interrupt(child, told);
    if (waitpid(child, &status, 0) >= 0) break;
    if (errno != EINTR) return exit_other;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string last_lines(const std::string& text, std::size_t lines) {
  std::size_t at = text.size();
  if (at > 0 && text[at - 1] == '\n') --at;
  for (; at > 0; --at)
    if (text[at - 1] == '\n' && --lines == 0) break;
  return text.substr(at);
}

}  // namespace nook::tool
