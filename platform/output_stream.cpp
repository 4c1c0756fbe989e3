#include "platform/output_stream.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace platform {
namespace {

[[noreturn]] void fail(int error) {
  throw std::runtime_error(std::string("the output stream cannot be written (") + std::strerror(error) +
                           "); the result is incomplete");
}

}  // namespace

bool has_output_stream() {
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

void print(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    fail(errno);
}

void require_printed() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) fail(errno ? errno : EIO);
}

}  // namespace platform
