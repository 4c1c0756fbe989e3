// Progress of long work on the error stream: one line that is redrawn on a terminal, a line for each tenth
// elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace crowd {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();  // leaves the cursor on a fresh line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // A new label begins a new line. unit names what is counted, such as "poses".
  void show(const std::string& label, const char* unit, std::uint64_t done, std::uint64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_, terminal_, open_ = false;
  std::string label_;
  std::uint64_t tenths_ = 0;
  Clock::time_point began_, drawn_;
};

}  // namespace crowd
