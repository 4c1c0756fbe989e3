#include "platform/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace platform {
namespace {

namespace fs = std::filesystem;

const std::string part_mark = ".part-";
constexpr int max_links = 40;   // as Linux follows
constexpr int max_parts = 100;  // of one process beside one target

[[noreturn]] void fail(const fs::path& target, int error) {
  throw std::runtime_error(target.string() + ": cannot be written (" + std::strerror(error) +
                           "); choose a place that exists and can be written");
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// The number N of /proc/self/fd/N, where a path such as /dev/stdout ends; -1 for other paths.
int own_descriptor(const fs::path& path) {
  struct stat folder, own;
  if (stat(folder_of(path).c_str(), &folder) != 0 || stat("/proc/self/fd", &own) != 0 ||
      !same_file(folder, own))
    return -1;
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

// Returns whether the name is TARGET.part-DIGITS, also with a second number after a dash.
bool is_part_of(const std::string& name, const std::string& target) {
  const std::string start = target + part_mark;
  return name.size() > start.size() && name.starts_with(start) &&
         std::all_of(name.begin() + std::ptrdiff_t(start.size()), name.end(),
                     [](char c) { return (c >= '0' && c <= '9') || c == '-'; });
}

bool lock(int descriptor) {
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// A live process holds a lock on its part, which the kernel gives up with the process, however that ends.
void remove_if_abandoned(const fs::path& part) {
  const int descriptor = open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  struct stat opened;
  if (fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && lock(descriptor)) unlink(part.c_str());
  close(descriptor);
}

void remove_abandoned_parts(const fs::path& target) {
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error))
    if (is_part_of(entry->path().filename().string(), target.filename().string()))
      remove_if_abandoned(entry->path());
}

// A descriptor of a new part, locked; -1 where one of this name is there, or another process has just removed
// it.
int try_part(const fs::path& part, const fs::path& named) {
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno != EEXIST) fail(named, errno);
  if (descriptor < 0) return -1;
  const bool locked = lock(descriptor) || errno != EWOULDBLOCK;  // some file systems have no locks
  struct stat opened, there;
  if (locked && fstat(descriptor, &opened) == 0 && lstat(part.c_str(), &there) == 0 &&
      same_file(opened, there))
    return descriptor;
  close(descriptor);
  return -1;
}

}  // namespace

fs::path followed(const fs::path& path) {
  fs::path at = path;
  for (int links = 0; links <= max_links; ++links) {
    // An entry of /proc/self/fd looks like a link to a path; a pipe's path does not exist.
    std::error_code error;
    if (own_descriptor(at) >= 0 || !fs::is_symlink(at, error)) return at;
    const fs::path next = fs::read_symlink(at, error);
    if (error) fail(path, error.value());
    at = next.is_absolute() ? next : folder_of(at) / next;
  }
  fail(path, ELOOP);
}

OutputFile::OutputFile(fs::path target) : named_(std::move(target)), target_(followed(named_)) {
  if (const int own = own_descriptor(target_); own >= 0) {
    descriptor_ = fcntl(own, F_DUPFD_CLOEXEC, 0);
  } else {
    struct stat there;
    const bool exists = stat(target_.c_str(), &there) == 0;
    if (!exists || S_ISREG(there.st_mode))
      open_part();
    else
      descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  }
  if (descriptor_ < 0) fail(named_, errno);
}

void OutputFile::open_part() {
  if (!target_.has_filename()) fail(named_, EISDIR);
  remove_abandoned_parts(target_);
  const std::string start = target_.string() + part_mark + std::to_string(getpid());
  for (int attempt = 0; attempt < max_parts && descriptor_ < 0; ++attempt) {
    part_ = attempt == 0 ? start : start + "-" + std::to_string(attempt);
    descriptor_ = try_part(part_, named_);
  }
  if (descriptor_ < 0) fail(named_, EEXIST);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (is_regular()) unlink(part_.c_str());
  close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(named_, errno);
    bytes = bytes.subspan(std::size_t(written));
  }
}

void OutputFile::commit(std::span<const std::byte> bytes) {
  write(bytes);
  if (is_regular()) {
    // The bytes are on the disk before they take the place of an older file. Some file systems cannot
    // synchronise, which is no fault.
    if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(named_, errno);
    if (rename(part_.c_str(), target_.c_str()) != 0) fail(named_, errno);
  }
  if (close(std::exchange(descriptor_, -1)) != 0) fail(named_, errno);
}

void OutputFile::commit(std::string_view text) {
  commit(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace platform
