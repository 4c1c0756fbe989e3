// The unfinished files beside a target that output_file.h writes.
#pragma once

#include <filesystem>

namespace platform {

struct PartFile {
  std::filesystem::path path;
  int descriptor = -1;
};

// Bytes at the front of a part that are written last: until then they mark the file as a part.
inline constexpr std::size_t part_mark_size = 64;

// A new part of a target, locked and marked. Its descriptor is -1 and errno set where none can be made.
PartFile make_part(const std::filesystem::path& target, unsigned mode);

// Removes the parts of dead processes. A file is one of them if its name is TARGET.nook-part-PID, its first
// bytes are the mark of this process, the process is dead, and nobody holds its lock.
void remove_abandoned_parts(const std::filesystem::path& target);

// The folder of a path as one that can be opened.
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace platform
