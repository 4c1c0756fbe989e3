// Waits for the other end of a pipe and still reacts when the user stops the program.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace platform {

// How a reader or writer of files asks its program and reports to it. Each function may be empty.
struct FileEvents {
  std::function<bool()> stopped;                     // return true to end a wait with Stopped
  std::function<void(const std::string&)> waits;     // called once, after waiting_seconds, with the reason;
                                                     // if empty, stderr gets it
  std::function<void(const std::string&)> replaces;  // called when replacing a file does what the user may
                                                     // not expect
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
  // Call it when something came: the next message then needs another waiting_seconds.
  void restart() { steps_ = 0; }

 private:
  const FileEvents& events_;
  std::string what_;
  int steps_ = 0;
  bool said_ = false;
};

// Waits until a descriptor can be read (POLLIN) or written (POLLOUT), or until its other end is closed.
void wait_until_ready(int descriptor, short event, Wait& wait);

}  // namespace platform
