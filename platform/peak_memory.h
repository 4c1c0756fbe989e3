// Measures the peak memory of the process. This header can also be used by libraries that do not link
// `platform`, because it needs no object file.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace platform {

inline std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace platform
