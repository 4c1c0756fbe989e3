// Waits for the other end of a pipe. The user can stop the program during the wait.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace platform {

// Callbacks for the program while files are read or written. Each function may be empty.
struct FileEvents {
  std::function<bool()> stopped;                     // return true to end a wait; the wait then throws
                                                     // Stopped
  std::function<void(const std::string&)> waits;     // called once, after waiting_seconds, with the reason of
                                                     // the wait; if empty, the reason is written to stderr
  std::function<void(const std::string&)> replaces;  // called with a note if replacing a file has an effect
                                                     // that the user may not expect
};

inline constexpr double waiting_seconds = 2;

// Thrown if the user ended a wait.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One wait. Poll in intervals of step_ms, and call step() after each interval in which nothing arrived.
class Wait {
 public:
  static constexpr int step_ms = 50;

  // `what` is the complete message for the user, for example "fifo: waits for a program that reads it".
  Wait(const FileEvents& events, std::string what) : events_(events), what_(std::move(what)) {}

  void step();
  // Call it when something arrived. The next message then comes after another waiting_seconds.
  void restart() { steps_ = 0; }

 private:
  const FileEvents& events_;
  std::string what_;
  int steps_ = 0;
  bool said_ = false;
};

// Waits until a descriptor can be read (POLLIN) or written (POLLOUT), or until the other end is closed.
void wait_until_ready(int descriptor, short event, Wait& wait);

}  // namespace platform
