// Reads input files of a program. They may also be pipes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "platform/file_waits.h"

namespace platform {

// Reads a whole file, or a pipe, a terminal or a socket (/dev/stdin) up to its end. Throws std::runtime_error
// with the name of the file if the file cannot be read, has more than max_bytes, or changes its size during
// the call. The size is checked before memory is allocated, except for streams, whose size is not known in
// advance. Throws Stopped if the user ends the wait.
std::vector<std::byte> read_input(const std::filesystem::path& path, std::uint64_t max_bytes,
                                  const FileEvents& events);

// Returns true if a path is a pipe, a socket or a terminal. You can read such a stream only once, and reading
// may wait forever.
bool is_stream(const std::filesystem::path& path);

// Copies a stream to a temporary file of the same name, for readers that need the size or read more than
// once. The destructor deletes the file.
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
