#include "platform/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <span>
#include <string>

#include "platform/output_file.h"

namespace platform {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": " + why);
}

[[noreturn]] void fail_errno(const fs::path& path, int error) {
  fail(path, std::string("cannot be read (") + std::strerror(error) + ")");
}

// A file descriptor that is closed by the destructor.
class Descriptor {
 public:
  // Opens with O_NONBLOCK, so that opening a pipe does not wait for its writer.
  explicit Descriptor(const fs::path& path) {
    const int own = own_descriptor(followed(path));
    number_ =
        own >= 0 ? fcntl(own, F_DUPFD_CLOEXEC, 0) : open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (number_ < 0) fail_errno(path, errno);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_ = -1;
};

// Returns the number of bytes read, 0 at the end.
std::size_t read_some(const Descriptor& file, const fs::path& path, std::span<std::byte> out, Wait* wait) {
  for (;;) {
    if (wait) wait_until_ready(file.number(), POLLIN, *wait);
    const ssize_t got = read(file.number(), out.data(), out.size());
    if (got >= 0) return std::size_t(got);
    if (errno != EINTR && errno != EAGAIN) fail_errno(path, errno);
  }
}

[[noreturn]] void fail_large(const fs::path& path, std::uint64_t max_bytes) {
  fail(path, "is too large (need at most " + std::to_string(max_bytes) + " bytes)");
}

// Calls `take` with each piece of data that arrives from a stream.
template <class Take>
void read_stream(const Descriptor& file, const fs::path& path, std::uint64_t max_bytes,
                 const FileEvents& events, Take&& take) {
  std::vector<std::byte> block(std::size_t{1} << 16);
  Wait wait(events, path.string() + ": waits for a program that writes to it");
  std::uint64_t total = 0;
  while (const std::size_t got = read_some(file, path, block, &wait)) {
    wait.restart();
    total += got;
    if (total > max_bytes) fail_large(path, max_bytes);
    take(std::span<const std::byte>(block).first(got));
  }
}

std::vector<std::byte> read_regular(const Descriptor& file, const fs::path& path, std::uint64_t size) {
  std::vector<std::byte> bytes(size);
  std::span<std::byte> left(bytes);
  while (!left.empty()) {
    const std::size_t got = read_some(file, path, left, nullptr);
    if (got == 0) fail(path, "became shorter while it was read; run the command again when it is complete");
    left = left.subspan(got);
  }
  std::byte more;
  if (read_some(file, path, std::span(&more, 1), nullptr) != 0)
    fail(path, "grew while it was read; run the command again when it is complete");
  return bytes;
}

bool is_stream(const struct stat& there, const fs::path& path) {
  if (S_ISFIFO(there.st_mode) || S_ISSOCK(there.st_mode)) return true;
  if (!S_ISCHR(there.st_mode)) return false;
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  const bool terminal = descriptor >= 0 && isatty(descriptor);
  if (descriptor >= 0) close(descriptor);
  return terminal;
}

}  // namespace

bool is_stream(const fs::path& path) {
  struct stat there;
  return stat(path.c_str(), &there) == 0 && is_stream(there, path);
}

std::vector<std::byte> read_input(const fs::path& path, std::uint64_t max_bytes, const FileEvents& events) {
  const Descriptor file(path);
  struct stat there;
  if (fstat(file.number(), &there) != 0) fail_errno(path, errno);
  if (S_ISDIR(there.st_mode)) fail_errno(path, EISDIR);
  if (S_ISREG(there.st_mode)) {
    if (std::uint64_t(there.st_size) > max_bytes) fail_large(path, max_bytes);
    return read_regular(file, path, std::uint64_t(there.st_size));
  }
  std::vector<std::byte> bytes;
  read_stream(file, path, max_bytes, events,
              [&](std::span<const std::byte> came) { bytes.insert(bytes.end(), came.begin(), came.end()); });
  return bytes;
}

InputCopy::InputCopy(const fs::path& stream, std::uint64_t max_bytes, const FileEvents& events) {
  const Descriptor file(stream);
  std::error_code missing;
  const fs::path temporary = fs::temp_directory_path(missing);
  if (missing) fail(stream, "needs a folder for temporary files (TMPDIR); set it to one that exists");
  std::string name = (temporary / "nook-input-XXXXXX").string();
  if (!mkdtemp(name.data())) fail(name, std::string("cannot be created (") + std::strerror(errno) + ")");
  folder_ = name;
  path_ = folder_ / stream.filename();
  try {
    std::ofstream copy(path_, std::ios::binary);
    read_stream(file, stream, max_bytes, events, [&](std::span<const std::byte> came) {
      copy.write(reinterpret_cast<const char*>(came.data()), std::streamsize(came.size()));
      if (!copy) fail(path_, "cannot be written; it is a copy of " + stream.string());
    });
    if (!copy.flush()) fail(path_, "cannot be written; it is a copy of " + stream.string());
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

InputCopy::~InputCopy() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace platform
