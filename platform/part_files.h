// Creates and removes parts, the unfinished files that output_file.h writes in the folder of a target.
#pragma once

#include <filesystem>

namespace platform {

struct PartFile {
  std::filesystem::path path;
  int descriptor = -1;
};

// The first bytes of a part are a mark that identifies it as a part. The content overwrites them last.
inline constexpr std::size_t part_mark_size = 64;

// Creates a part of a target, locks it and writes the mark. On failure, the descriptor is -1 and errno is
// set.
PartFile make_part(const std::filesystem::path& target, unsigned mode);

// Removes the parts of dead processes. A file is removed only if its name is TARGET.nook-part-PID, its first
// bytes are the mark of the process PID, this process is dead, and nobody holds the lock.
void remove_abandoned_parts(const std::filesystem::path& target);

// Returns the folder of a path in a form that can be opened.
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace platform
