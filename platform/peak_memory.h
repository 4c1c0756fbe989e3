// The memory that the process has taken. A header without objects of its own, so that libraries can include
// it.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace platform {

// Returns the peak memory of the process since it started.
inline std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace platform
