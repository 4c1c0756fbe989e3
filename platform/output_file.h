// Writes a file so that it appears either completely or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "platform/file_waits.h"

namespace platform {

// A regular file is first written to a part, TARGET.nook-part-PID, in the same folder. commit() renames the
// part to the target. Without commit(), the destructor removes the part. The new file takes over the mode of
// the old file, and its owner and attributes if the system allows this. A symbolic link is replaced. The file
// to which it points is not changed, because it may be shared with others, for example in a cache. Devices,
// pipes and the program's own streams (/dev/stdout) are never replaced, even if the path is a link to them.
// commit() writes to them instead. The constructor opens everything, and waits for the reader of a pipe. So a
// target that cannot be written causes a failure before the work begins. The constructor refuses a
// write-protected file. It also removes parts of the target that dead processes have left, which it
// recognises by their names and first bytes. On failure, throws std::runtime_error with a text that contains
// the name of the file.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target, FileEvents events = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Writes the file. Call it only once.
  void commit(std::span<const std::byte> bytes);
  void commit(std::string_view text);

  // Returns false for a device, a pipe or a stream, because data that was written to it cannot be replaced
  // later.
  bool is_regular() const { return !part_.empty(); }

 private:
  void open_stream();
  void open_part();
  void write_stream(std::span<const std::byte> bytes);
  void write_part(std::span<const std::byte> bytes);
  void replace_target(std::span<const std::byte> bytes);

  FileEvents events_;
  std::filesystem::path named_, target_;  // the path from the user, and the path that commit() writes or
                                          // replaces
  std::filesystem::path part_;            // if empty, the target is written directly
  int descriptor_ = -1;
};

// Follows the symbolic links of a path, and returns the resulting path. The file need not exist. Throws
// std::runtime_error if the links form a circle.
std::filesystem::path followed(const std::filesystem::path& path);

// Returns N if a path such as /dev/stdout leads to /proc/self/fd/N. Returns -1 for other paths.
int own_descriptor(const std::filesystem::path& path);

}  // namespace platform
