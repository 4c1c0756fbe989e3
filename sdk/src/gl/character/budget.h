// The time that a call on the OpenGL thread may take.
#pragma once

#include <chrono>
#include <cstdint>

namespace nook::gl {

class Budget {
 public:
  explicit Budget(std::uint32_t microseconds)
      : end_(Clock::now() + std::chrono::microseconds(microseconds)) {}
  static Budget unlimited() { return Budget(Clock::time_point::max()); }

  bool is_left() const { return Clock::now() < end_; }

 private:
  using Clock = std::chrono::steady_clock;
  explicit Budget(Clock::time_point end) : end_(end) {}

  Clock::time_point end_;
};

}  // namespace nook::gl
