// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace nook::tool {

// Opens a neighbour of the target at once, so that a place where nothing can be written is known before the
// work begins; commit() fills it and renames it to the target. Without commit() the neighbour is removed.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void commit(std::span<const std::byte> bytes);
  void commit(std::string_view text);

 private:
  std::filesystem::path target_, beside_;
  int descriptor_ = -1;
};

}  // namespace nook::tool
