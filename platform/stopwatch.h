// Wall-clock time. A header without objects of its own, so that libraries can include it.
#pragma once

#include <chrono>

namespace platform {

class Stopwatch {
 public:
  // Seconds since the construction or the last lap.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - last_).count(); }

  // The same, in seconds or milliseconds, and begins a new lap.
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
