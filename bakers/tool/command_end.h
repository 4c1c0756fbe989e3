// Ways to end a command before its work is done. A failure has a text for the user and a documented exit
// code. Ctrl-C only sets a flag, which the command has to check.
#pragma once

#include <nook/nook.h>

#include <stdexcept>
#include <string>

#include "platform/file_waits.h"

namespace nook::tool {

enum ExitCode {
  exit_done = 0,
  exit_other = 1,
  exit_bad_arguments = 2,
  exit_bad_input = 3,
  exit_bad_result = 4
};

class ToolError : public std::runtime_error {
 public:
  ToolError(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Throw this to end a command with an exit code when the command has already told the user the reason. The
// code can be the exit code of another program that the command ran.
class CommandEnd {
 public:
  explicit CommandEnd(int code) : code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};

inline ExitCode exit_code_of(nook_result result) {
  switch (result) {
    case NOOK_OK:
      return exit_done;
    case NOOK_ERROR_INVALID_ARGUMENT:
      return exit_bad_arguments;
    case NOOK_ERROR_BAD_FILE:
    case NOOK_ERROR_FILE_VERSION:
      return exit_bad_input;
    default:
      return exit_other;
  }
}

// Makes Ctrl-C set a flag that long work checks between its steps. The first SIGINT, SIGTERM or SIGHUP sets
// the flag. The second of these signals ends the process at once. A signal that was ignored when the program
// began stays ignored.
void watch_for_interrupt();
bool interrupted();

// Returns the event callbacks for reading and writing files that may be pipes. While a command waits for a
// pipe, a message on the error stream says so, and the wait ends when the flag is set. Unless `quiet` is
// true, messages also report what else happens to a file that is replaced.
platform::FileEvents file_events(bool quiet);

}  // namespace nook::tool
