// A file that a program writes either appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "platform/file_waits.h"

namespace platform {

// The program writes a regular file to a part beside its target, TARGET.nook-part-PID. commit() renames the
// part to the target; without commit() the destructor removes it. The new file takes over the old file's
// mode, and its owner and attributes where the system allows that. A symbolic link is replaced, and the file
// that it points to stays as it is: it may be shared with others, as in a cache. Devices, pipes and the
// program's own streams (/dev/stdout) are never replaced, also behind a link: commit() writes to them. The
// constructor opens everything and waits for the reader of a pipe, so that you learn before the work begins
// if nothing can be written there. It refuses a write-protected file. It also removes parts that dead
// processes left beside the target, which it recognises by their names and first bytes. Failures are
// std::runtime_error with a text that names the file.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target, FileEvents events = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Call it once.
  void commit(std::span<const std::byte> bytes);
  void commit(std::string_view text);

  // False for a device, a pipe or a stream: a later version cannot replace what was written.
  bool is_regular() const { return !part_.empty(); }

 private:
  void open_stream();
  void open_part();
  void write_stream(std::span<const std::byte> bytes);
  void write_part(std::span<const std::byte> bytes);
  void replace_target(std::span<const std::byte> bytes);

  FileEvents events_;
  std::filesystem::path named_, target_;  // as the user named it, and what commit() writes or replaces
  std::filesystem::path part_;            // empty: the target is written directly
  int descriptor_ = -1;
};

// Returns the file that a path leads to when its symbolic links are followed; it need not exist. Throws
// std::runtime_error if the links form a circle.
std::filesystem::path followed(const std::filesystem::path& path);

// The number N of /proc/self/fd/N, where a path such as /dev/stdout ends; -1 for other paths.
int own_descriptor(const std::filesystem::path& path);

}  // namespace platform
