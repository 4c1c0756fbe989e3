#include "platform/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "platform/printable.h"

namespace platform {
namespace {

constexpr double seconds_between_draws = 0.1;
constexpr double seconds_before_rate = 0.3;  // in the first moments, the rate is too inaccurate

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

std::string duration_text(double seconds) {
  char text[40];
  const long s = std::lround(std::max(0.0, std::min(seconds, 1e9)));
  if (s < 60)
    std::snprintf(text, sizeof text, "%ld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof text, "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s / 60 % 60);
  return text;
}

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
  end_line();
}

void ProgressBar::begin(const std::string& label, std::size_t done) {
  end_line();
  label_ = label;
  shown_label_ = printable(label);
  first_ = done;
  began_ = Clock::now();
  drawn_ = {};
  tenths_ = 0;
}

void ProgressBar::end_line() {
  if (!line_open_) return;
  std::fputc('\n', stderr);
  line_open_ = false;
}

void ProgressBar::show(const std::string& label, const char* unit, std::size_t done, std::size_t total) {
  if (quiet_) return;
  if (label != label_ || done < done_) begin(label, done);
  done_ = done;
  total_ = total;
  const auto now = Clock::now();
  const double elapsed = seconds(now - began_);
  const double rate = elapsed > seconds_before_rate ? double(done - first_) / elapsed : 0;
  const double left = rate > 0 ? double(total - std::min(done, total)) / rate : 0;
  if (terminal_) {
    if (done < total && seconds(now - drawn_) < seconds_between_draws) return;
    drawn_ = now;
    draw(unit, rate, left);
    return;
  }
  // If the stream is not a terminal, prints one line at the start, and one for each tenth of the work.
  const std::size_t tenths = total > 0 ? 10 * done / total : 0;
  if (drawn_ != Clock::time_point{} && tenths <= tenths_) return;
  drawn_ = now;
  tenths_ = tenths;
  if (rate > 0 && done < total)
    std::fprintf(stderr, "%s: %zu of %zu %s, %s left\n", shown_label_.c_str(), done, total, unit,
                 duration_text(left).c_str());
  else
    std::fprintf(stderr, "%s: %zu of %zu %s\n", shown_label_.c_str(), done, total, unit);
}

void ProgressBar::draw(const char* unit, double rate, double seconds_left) {
  char tail[120];
  if (done_ >= total_ || rate <= 0)
    std::snprintf(tail, sizeof tail, " %zu/%zu %s", done_, total_, unit);
  else
    std::snprintf(tail, sizeof tail, " %zu/%zu %s, %.3g/s, %s left", done_, total_, unit, rate,
                  duration_text(seconds_left).c_str());
  const int width =
      std::clamp(terminal_columns() - int(shown_label_.size() + std::string(tail).size()) - 4, 5, 40);
  const double share = total_ > 0 ? double(done_) / double(total_) : 0;
  const int filled = std::clamp(int(std::lround(share * width)), 0, width);
  // \x1b[K erases the rest of the line, because the previous text may have been longer.
  std::fprintf(stderr, "\r%s [%s%s]%s\x1b[K", shown_label_.c_str(),
               std::string(std::size_t(filled), '#').c_str(),
               std::string(std::size_t(width - filled), '.').c_str(), tail);
  std::fflush(stderr);
  line_open_ = true;
}

}  // namespace platform
