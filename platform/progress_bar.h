// Shows the progress of long work on the error stream. On a terminal it shows a bar, otherwise plain lines.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace platform {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();  // puts the cursor on a new line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `unit` is the name of the counted things, for example "poses". A new label begins a new line. Do not call
  // it from several threads at the same time.
  void show(const std::string& label, const char* unit, std::size_t done, std::size_t total);

 private:
  using Clock = std::chrono::steady_clock;

  void begin(const std::string& label, std::size_t done);
  void end_line();
  void draw(const char* unit, double rate, double seconds_left);

  bool quiet_, terminal_;
  std::string label_, shown_label_;  // the label as passed, and as printed
  std::size_t first_ = 0, done_ = 0, total_ = 0, tenths_ = 0;
  Clock::time_point began_, drawn_;
  bool line_open_ = false;
};

// Returns a duration such as "12 s", "3 min 05 s" or "1 h 02 min".
std::string duration_text(double seconds);

}  // namespace platform
