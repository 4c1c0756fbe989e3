// Measures wall-clock time. Libraries can include this header, because it has no objects of its own.
#pragma once

#include <chrono>

namespace platform {

class Stopwatch {
 public:
  // Seconds since construction or the last lap.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - last_).count(); }

  // Returns seconds() or the same in milliseconds, and begins a new lap.
  double lap_seconds() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }
  double lap_ms() { return 1000 * lap_seconds(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace platform
