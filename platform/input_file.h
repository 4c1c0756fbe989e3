// Reads files that a user names as inputs, which may be pipes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "platform/file_waits.h"

namespace platform {

// Reads a whole file, or a pipe, a terminal or a socket (/dev/stdin) up to its end. Throws std::runtime_error
// with a text that names the file if it cannot be read, has more than max_bytes, or changes its size
// meanwhile. Only a pipe takes memory before the size is checked. Throws Stopped if the user ends the wait.
std::vector<std::byte> read_input(const std::filesystem::path& path, std::uint64_t max_bytes,
                                  const FileEvents& events);

// Returns whether a path names a pipe, a socket or a terminal: you can read it only once, and it may wait for
// ever.
bool is_stream(const std::filesystem::path& path);

// Copies a stream to a temporary file of the same name, for readers that need a size or read twice. The
// destructor deletes the file.
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
