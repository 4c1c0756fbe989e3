// Ways to end a command before its work is done. A failure has a text for the user and a documented exit
// code. Ctrl-C sets a flag.
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

// Thrown to end a command with an exit code after the command has already told the user why. The code can be
// the exit code of a program that the command ran.
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

// Makes Ctrl-C set a flag, which long work checks between its steps. The first SIGINT, SIGTERM or SIGHUP sets
// the flag. A second one ends the process at once. A signal that was ignored when the program began stays
// ignored.
void watch_for_interrupt();
bool interrupted();

// Returns events for files that may be pipes: waiting for such a file ends when the flag is set. Messages on
// the error stream say what a command waits for. Without --quiet, messages also report other effects on a
// file that is replaced.
platform::FileEvents file_events(bool quiet);

}  // namespace nook::tool
