#include "platform/part_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

namespace platform {
namespace {

namespace fs = std::filesystem;

constexpr int max_parts = 100;           // maximum number of parts for one process and one target
constexpr std::size_t name_bytes = 200;  // bytes used of the target's name, because a whole file name has at
                                         // most 255 bytes

using Mark = std::array<char, part_mark_size>;

Mark mark_of(long process) {
  Mark mark;
  mark.fill(' ');
  char text[part_mark_size];
  const int size = std::snprintf(text, sizeof text, "nook: an unfinished file of process %ld", process);
  std::memcpy(mark.data(), text, std::size_t(size));
  mark.back() = '\n';
  return mark;
}

std::string start_of(const fs::path& target) {
  return target.filename().string().substr(0, name_bytes) + ".nook-part-";
}

// Returns the process ID in a name such as START123 or START123-4. Returns 0 for other names.
long process_of(const std::string& name, const std::string& start) {
  if (!name.starts_with(start)) return 0;
  const char* at = name.data() + start.size();
  const char* const end = name.data() + name.size();
  long process = 0;
  const auto [after, error] = std::from_chars(at, end, process);
  if (error != std::errc() || process <= 0) return 0;
  const bool numbered = after != end && *after == '-' && after + 1 != end &&
                        std::all_of(after + 1, end, [](char c) { return c >= '0' && c <= '9'; });
  return after == end || numbered ? process : 0;
}

// A file with the ID of this process may belong to an earlier process, because in a container process IDs
// begin at 1.
bool is_dead(long process) {
  return process == getpid() || (kill(pid_t(process), 0) != 0 && errno == ESRCH);
}

bool lock(int descriptor) {
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

bool has_mark(int descriptor, long process) {
  Mark found{};
  return pread(descriptor, found.data(), found.size(), 0) == ssize_t(found.size()) &&
         found == mark_of(process);
}

// A running process also holds a lock on its part. When the process ends, even by a crash, the kernel
// releases the lock.
void remove_if_abandoned(const fs::path& part, long process) {
  // Opens for writing, because NFS can lock only such files.
  const int descriptor = open(part.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  struct stat opened;
  if (fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && has_mark(descriptor, process) &&
      lock(descriptor))
    unlink(part.c_str());
  close(descriptor);
}

bool same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Returns the descriptor of a new, locked part. Returns -1 if a part with this name already exists (EEXIST),
// or if another process has just removed the new part.
int try_part(const fs::path& part, unsigned mode) {
  const int descriptor = open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) return -1;
  const bool locked = lock(descriptor) || errno != EWOULDBLOCK;  // some file systems do not support locks
  struct stat opened, there;
  if (locked && fstat(descriptor, &opened) == 0 && lstat(part.c_str(), &there) == 0 &&
      same_file(opened, there))
    return descriptor;
  close(descriptor);
  errno = EEXIST;
  return -1;
}

}  // namespace

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

PartFile make_part(const fs::path& target, unsigned mode) {
  const std::string start = start_of(target) + std::to_string(getpid());
  PartFile part;
  for (int attempt = 0; attempt < max_parts && part.descriptor < 0; ++attempt) {
    part.path = target.parent_path() / (attempt == 0 ? start : start + "-" + std::to_string(attempt));
    part.descriptor = try_part(part.path, mode);
    if (part.descriptor < 0 && errno != EEXIST) return part;
  }
  if (part.descriptor < 0) return part;
  const Mark mark = mark_of(getpid());
  const ssize_t written = pwrite(part.descriptor, mark.data(), mark.size(), 0);
  if (written == ssize_t(mark.size())) return part;
  const int error = written < 0 ? errno : ENOSPC;
  unlink(part.path.c_str());
  close(part.descriptor);
  errno = error;
  return {part.path, -1};
}

void remove_abandoned_parts(const fs::path& target) {
  const std::string start = start_of(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error))
    if (const long process = process_of(entry->path().filename().string(), start);
        process > 0 && is_dead(process))
      remove_if_abandoned(entry->path(), process);
}

}  // namespace platform
