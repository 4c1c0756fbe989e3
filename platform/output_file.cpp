#include "platform/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>
#include <utility>

#include "platform/file_attributes.h"
#include "platform/part_files.h"

namespace platform {
namespace {

namespace fs = std::filesystem;

constexpr int max_links = 40;  // the same limit as on Linux

[[noreturn]] void fail(const fs::path& target, const std::string& why,
                       const char* cure = "choose an existing folder that you can write to") {
  throw std::runtime_error(target.string() + ": cannot be written (" + why + "); " + cure);
}

[[noreturn]] void fail_errno(const fs::path& target, int error) {
  fail(target, std::strerror(error));
}

bool same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Root may write to every file. But if a file has no write permission at all, its owner wants to protect it,
// so root does not overwrite it here either.
void require_writable(const fs::path& named, const fs::path& target, const struct stat& there) {
  if ((there.st_mode & 0222) == 0)
    fail(named, "it is write-protected", "make it writable (chmod u+w), or choose another place");
  if (faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail_errno(named, errno);
}

// Returns the path that is written. For devices, pipes and the program's own streams, symbolic links are
// followed. A link to anything else is replaced itself, so the path is returned unchanged. Throws
// std::runtime_error if links form a circle.
fs::path written_place(const fs::path& named) {
  const fs::path target = followed(named);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  const bool is_replaced = !fs::exists(status) || fs::is_regular_file(status);
  return own_descriptor(target) < 0 && is_replaced ? named : target;
}

}  // namespace

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

fs::path followed(const fs::path& path) {
  fs::path at = path;
  for (int links = 0; links <= max_links; ++links) {
    // An entry of /proc/self/fd looks like a link. But for a pipe, the path to which it points does not
    // exist.
    std::error_code error;
    if (own_descriptor(at) >= 0 || !fs::is_symlink(at, error)) return at;
    const fs::path next = fs::read_symlink(at, error);
    if (error) fail_errno(path, error.value());
    at = next.is_absolute() ? next : folder_of(at) / next;
  }
  fail_errno(path, ELOOP);
}

OutputFile::OutputFile(fs::path target, FileEvents events)
    : events_(std::move(events)), named_(std::move(target)), target_(written_place(named_)) {
  if (const int own = own_descriptor(target_); own >= 0) {
    // A stream that was closed when the program started cannot be written to; see standard_streams.h.
    const int flags = fcntl(own, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) fail_errno(named_, EBADF);
    descriptor_ = fcntl(own, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail_errno(named_, errno);
    return;
  }
  struct stat there;
  if (stat(target_.c_str(), &there) == 0 && !S_ISREG(there.st_mode))
    open_stream();
  else
    open_part();
}

// Repeats opening a pipe, because it fails with ENXIO until a program reads the pipe.
void OutputFile::open_stream() {
  std::error_code error;
  if (fs::is_directory(target_, error)) fail(named_, "it is a folder", "add the name of a file");
  Wait wait(events_, named_.string() + ": waits for a program that reads it");
  for (;;) {
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ >= 0) return;
    if (errno != EINTR && (errno != ENXIO || !fs::is_fifo(target_, error))) fail_errno(named_, errno);
    poll(nullptr, 0, Wait::step_ms);
    wait.step();
  }
}

void OutputFile::open_part() {
  if (!target_.has_filename()) fail(named_, "it is a folder", "add the name of a file");
  remove_abandoned_parts(target_);
  struct stat there;
  const bool is_there = lstat(target_.c_str(), &there) == 0;
  if (!is_there && errno != ENOENT) fail_errno(named_, errno);
  // A link is replaced by a new file. The new file does not take over any attributes of the file to which the
  // link points.
  const bool is_link = is_there && S_ISLNK(there.st_mode), exists = is_there && !is_link;
  if (exists) require_writable(named_, target_, there);
  const PartFile part = make_part(target_, exists ? 0600 : 0666);
  if (part.descriptor < 0) {
    const int error = errno;
    if (exists && (error == EACCES || error == EROFS))
      fail(named_,
           std::string(std::strerror(error)) +
               ": the new file has to be created next to the old one, in the folder " +
               folder_of(target_).string(),
           "make that folder writable, or choose another place");
    fail_errno(named_, error);
  }
  part_ = part.path;
  descriptor_ = part.descriptor;
  std::string note = exists ? take_attributes(descriptor_, target_, there) : "";
  if (is_link)
    note = "the link is replaced by a file, and the file that it points to stays unchanged: " +
           followed(named_).string();
  if (!note.empty() && events_.replaces) events_.replaces(named_.string() + ": " + note);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (is_regular()) unlink(part_.c_str());
  close(descriptor_);
}

void OutputFile::write_stream(std::span<const std::byte> bytes) {
  // If a pipe is ready for writing, it has room for this many bytes (POSIX, PIPE_BUF).
  constexpr std::size_t piece = 4096;
  Wait wait(events_, named_.string() + ": waits for a program that reads it");
  while (!bytes.empty()) {
    wait_until_ready(descriptor_, POLLOUT, wait);
    const ssize_t written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), piece));
    if (written < 0 && errno != EINTR && errno != EAGAIN) fail_errno(named_, errno);
    if (written <= 0) {
      wait.step();
      continue;
    }
    wait.restart();
    bytes = bytes.subspan(std::size_t(written));
  }
}

// The mark is at the start of the file. So this function first writes the rest of the bytes, and then
// overwrites the mark with the first bytes. Until then, other processes recognise the file as a part.
void OutputFile::write_part(std::span<const std::byte> bytes) {
  const auto write_at = [&](std::span<const std::byte> left, std::size_t at) {
    while (!left.empty()) {
      const ssize_t written = pwrite(descriptor_, left.data(), left.size(), off_t(at));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail_errno(named_, errno);
      left = left.subspan(std::size_t(written));
      at += std::size_t(written);
    }
  };
  const std::size_t front = std::min(bytes.size(), part_mark_size);
  write_at(bytes.subspan(front), front);
  write_at(bytes.first(front), 0);
  if (ftruncate(descriptor_, off_t(bytes.size())) != 0) fail_errno(named_, errno);
  // The bytes must be on the disk before the part replaces an older file. It is not an error if the file
  // system does not support fsync.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail_errno(named_, errno);
}

void OutputFile::replace_target(std::span<const std::byte> bytes) {
  write_part(bytes);
  if (rename(part_.c_str(), target_.c_str()) == 0) return;
  std::error_code error;
  if (errno == ENOENT && fs::is_directory(folder_of(target_), error)) {
    // The part does not exist any more: somebody emptied the folder, or deleted it and created it again.
    // Tries again with a new part.
    close(std::exchange(descriptor_, -1));
    open_part();
    write_part(bytes);
    if (rename(part_.c_str(), target_.c_str()) == 0) return;
  } else if (errno == EBUSY) {
    // A mounted file, for example in a container, cannot be replaced by rename. So the part is removed, and
    // the target is overwritten in place.
    unlink(part_.c_str());
    close(std::exchange(descriptor_, -1));
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    part_.clear();
    if (descriptor_ < 0 || ftruncate(descriptor_, 0) != 0) fail_errno(named_, errno);
    write_stream(bytes);
    return;
  }
  fail_errno(named_, errno);
}

void OutputFile::commit(std::span<const std::byte> bytes) {
  if (is_regular())
    replace_target(bytes);
  else
    write_stream(bytes);
  if (close(std::exchange(descriptor_, -1)) != 0) fail_errno(named_, errno);
}

void OutputFile::commit(std::string_view text) {
  commit(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace platform
