// The memory that the process has used. Libraries can include this header, because it has no objects of its
// own.
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
