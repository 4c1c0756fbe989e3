#include "samples/crowd/progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace crowd {

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (open_) std::fputc('\n', stderr);
}

void ProgressLine::show(const std::string& label, const char* unit, std::uint64_t done, std::uint64_t total) {
  if (quiet_ || total == 0) return;
  const auto now = Clock::now();
  const bool fresh = label != label_;
  if (fresh) {
    if (open_) std::fputc('\n', stderr);
    open_ = false;
    label_ = label;
    began_ = now;
    tenths_ = 0;
  }
  const std::uint64_t tenths = 10 * done / total;
  const bool last = done == total;
  if (terminal_ ? !fresh && !last && now - drawn_ < std::chrono::milliseconds(100)
                : !fresh && tenths == tenths_)
    return;
  drawn_ = now;
  tenths_ = tenths;
  const double seconds = std::chrono::duration<double>(now - began_).count();
  const double rate = seconds > 0 ? double(done) / seconds : 0;
  char bar[21];
  for (std::uint64_t i = 0; i < 20; ++i) bar[i] = i < 20 * done / total ? '#' : '.';
  bar[20] = 0;
  std::fprintf(stderr, "%s%-13s [%s] %llu/%llu %s, %.1f/s, %.0f s left%s", terminal_ ? "\r" : "",
               label.c_str(), bar, static_cast<unsigned long long>(done),
               static_cast<unsigned long long>(total), unit, rate,
               rate > 0 ? double(total - done) / rate : 0.0, terminal_ ? "\033[K" : "\n");
  open_ = terminal_;
}

}  // namespace crowd
