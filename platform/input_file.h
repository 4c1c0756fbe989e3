// Files that a user names as inputs, which may be pipes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "platform/file_waits.h"

namespace platform {

// Reads a whole file, or a pipe, a terminal or a socket (/dev/stdin) up to its end. Throws std::runtime_error
// with a text that names the file: it cannot be read, has more than max_bytes (known before memory is taken,
// except of a pipe), or changed its size meanwhile; Stopped.
std::vector<std::byte> read_input(const std::filesystem::path& path, std::uint64_t max_bytes,
                                  const FileEvents& events);

// Returns whether a path names a pipe, a socket or a terminal, which can be read once and may wait for ever.
bool is_stream(const std::filesystem::path& path);

// A stream as a file: whatever comes is copied to a temporary file of the same name, for readers that need a
// size or read twice. The file goes with this object.
class InputCopy {
 public:
  InputCopy(const std::filesystem::path& stream, std::uint64_t max_bytes, const FileEvents& events);
  ~InputCopy();
  InputCopy(const InputCopy&) = delete;
  InputCopy& operator=(const InputCopy&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace platform
