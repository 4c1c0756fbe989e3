// Waiting for the other end of a pipe, without being deaf to the user.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace platform {

// Questions and messages of a reader or writer of files to its program. Each function may be empty.
struct FileEvents {
  std::function<bool()> stopped;                     // true ends a wait, by Stopped
  std::function<void(const std::string&)> waits;     // once, after waiting_seconds: the reason; empty: stderr
  std::function<void(const std::string&)> replaces;  // what a user may not expect when a file is replaced
};

inline constexpr double waiting_seconds = 2;

// The user ended a wait.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One wait. Poll what you wait for in steps of step_ms, and call step() after each that brought nothing.
class Wait {
 public:
  static constexpr int step_ms = 50;

  // what: the whole sentence that the user reads, for example "fifo: waits for a program that reads it".
  Wait(const FileEvents& events, std::string what) : events_(events), what_(std::move(what)) {}

  void step();
  // Something came: the next message needs another waiting_seconds.
  void restart() { steps_ = 0; }

 private:
  const FileEvents& events_;
  std::string what_;
  int steps_ = 0;
  bool said_ = false;
};

// Waits until a descriptor can be read (POLLIN) or written (POLLOUT), or its other end is gone.
void wait_until_ready(int descriptor, short event, Wait& wait);

}  // namespace platform
