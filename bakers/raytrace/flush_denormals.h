// Denormals as zero, for threads that trace.
#pragma once

#include <cstdint>

namespace nook::bake {

// Keep one on every thread that traces: Embree is much slower on denormals. The destructor restores the
// caller's mode. Processors other than x86 and ARM64 keep their mode.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  std::uint64_t saved_;
};

}  // namespace nook::bake
