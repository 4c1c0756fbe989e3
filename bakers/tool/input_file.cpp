#include "bakers/tool/input_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace nook::tool {

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw ToolError(exit_bad_input, path.string() + ": cannot be read (" + error.message() + ")");
  std::vector<std::byte> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size)))
    throw ToolError(exit_bad_input, path.string() + ": cannot be read (" + std::strerror(errno) + ")");
  return bytes;
}

}  // namespace nook::tool
