#include "bakers/tool/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bakers/tool/tool_error.h"

namespace nook::tool {
namespace {

[[noreturn]] void fail(const std::filesystem::path& target, int error) {
  throw ToolError(exit_other, target.string() + ": cannot be written (" + std::strerror(error) +
                                  "); choose a place that exists and can be written");
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path target) : target_(std::move(target)) {
  if (std::filesystem::is_directory(target_)) fail(target_, EISDIR);
  beside_ = target_;
  beside_ += ".part-" + std::to_string(getpid());
  descriptor_ = open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(target_, errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(beside_.c_str());
}

void OutputFile::commit(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(target_, errno);
    bytes = bytes.subspan(std::size_t(written));
  }
  // On the disk before it takes the place of an older file. Pipes and the like cannot be synchronised, which
  // is no fault.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(target_, errno);
  if (rename(beside_.c_str(), target_.c_str()) != 0) fail(target_, errno);
  close(descriptor_);
  descriptor_ = -1;
}

void OutputFile::commit(std::string_view text) {
  commit(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace nook::tool
