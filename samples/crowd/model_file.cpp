#include "samples/crowd/model_file.h"

#include <stdexcept>

#include "platform/file_bytes.h"

namespace crowd {

ModelFile::ModelFile(std::filesystem::path path) : path_(std::move(path)), seen_(state()) {}

std::optional<ModelFile::State> ModelFile::state() const {
  std::error_code absent;
  State now;
  now.time = std::filesystem::last_write_time(path_, absent);
  if (absent) return {};
  now.size = std::filesystem::file_size(path_, absent);
  if (absent) return {};
  return now;
}

bool ModelFile::has_change() const {
  const std::optional<State> now = state();
  return now && now != seen_;
}

std::optional<std::vector<unsigned char>> ModelFile::take_change() {
  const std::optional<State> now = state();
  if (!now || now == seen_) return {};
  try {
    std::vector<unsigned char> bytes = platform::read_file(path_);
    seen_ = now;
    return bytes;
  } catch (const std::runtime_error&) {
    return {};  // the next call finds the change again
  }
}

}  // namespace crowd
