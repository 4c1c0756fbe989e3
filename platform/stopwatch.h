// Measures wall-clock time. This header can also be used by libraries that do not link `platform`, because it
// needs no object file.
#pragma once

#include <chrono>

namespace platform {

class Stopwatch {
 public:
  // Returns the seconds since construction or since the last lap.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - last_).count(); }

  // lap_seconds and lap_ms return the time since the last lap, in seconds or milliseconds, and begin a new
  // lap.
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
