// A file that a program writes: it appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "platform/file_waits.h"

namespace platform {

// A regular file is written to a part beside its target, TARGET.nook-part-PID, which commit() renames to the
// target; without commit() the part is removed. The new file has the mode of the one that it replaces, and
// its owner and attributes where the system allows that. A symbolic link keeps its place: the file that it
// points to is replaced. Devices, pipes and the program's own streams (/dev/stdout) are never replaced:
// commit() writes to them. Everything is opened by the constructor, which waits for the reader of a pipe, so
// that a place where nothing can be written is known before the work begins. A file that is write-protected
// is refused. The constructor also removes the parts that dead processes left beside the target. It knows
// them by their names and by their first bytes, which are those of a part until it is whole. Failures are
// std::runtime_error with a text that names the file.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target, FileEvents events = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Once.
  void commit(std::span<const std::byte> bytes);
  void commit(std::string_view text);

  // False for a device, a pipe or a stream, where what was written cannot be replaced by a later version.
  bool is_regular() const { return !part_.empty(); }

 private:
  void open_stream();
  void open_part();
  void write_stream(std::span<const std::byte> bytes);
  void write_part(std::span<const std::byte> bytes);
  void replace_target(std::span<const std::byte> bytes);

  FileEvents events_;
  std::filesystem::path named_, target_;  // as the user named it, and what it stands for
  std::filesystem::path part_;            // empty: the target is written directly
  int descriptor_ = -1;
};

// The file that a path stands for once its symbolic links are followed; it need not exist. Throws
// std::runtime_error where the links form a circle.
std::filesystem::path followed(const std::filesystem::path& path);

// The number N of /proc/self/fd/N, where a path such as /dev/stdout ends; -1 for other paths.
int own_descriptor(const std::filesystem::path& path);

}  // namespace platform
