#include "bakers/tensor/mapped_tensor.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

struct OpenFile {
  explicit OpenFile(const std::string& path) : descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor;
};

// Offset and entries together, or the greatest number where they exceed it.
std::uint64_t bytes_needed(std::uint64_t offset, const Dimensions& dimensions) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t bytes = sizeof(float);
  for (std::size_t d : dimensions) {
    if (d != 0 && bytes > most / d) return most;
    bytes *= d;
  }
  return offset > most - bytes ? most : offset + bytes;
}

}  // namespace

MappedTensor::MappedTensor(const std::string& path, std::uint64_t offset, Dimensions dimensions) {
  if (offset % sizeof(float) != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the offset of a tensor's entries is %llu (need a multiple of 4)",
                  static_cast<unsigned long long>(offset));
  const OpenFile file(path);
  struct stat status {};
  if (file.descriptor < 0 || fstat(file.descriptor, &status) != 0)
    throw Failure(NOOK_ERROR_BAD_FILE, "cannot read %s: %s", path.c_str(), std::strerror(errno));
  const std::uint64_t needed = bytes_needed(offset, dimensions), length = std::uint64_t(status.st_size);
  if (length < needed)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is too short for its tensor (got %llu bytes, need %llu)",
                  path.c_str(), static_cast<unsigned long long>(length),
                  static_cast<unsigned long long>(needed));
  void* const map = mmap(nullptr, needed, PROT_READ, MAP_SHARED, file.descriptor, 0);
  if (map == MAP_FAILED)
    throw Failure(NOOK_ERROR_BAD_FILE, "cannot map %s: %s", path.c_str(), std::strerror(errno));
  map_ = map;
  bytes_ = std::size_t(needed);
  view_.dimensions = std::move(dimensions);
  view_.data = reinterpret_cast<const float*>(static_cast<const char*>(map) + offset);
}

MappedTensor::~MappedTensor() {
  munmap(map_, bytes_);
}

}  // namespace nook::bake::tensor
