#include "platform/file_bytes.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "platform/output_file.h"

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw std::runtime_error("read_file: " + path.string() + " cannot be read; check the path");
  return bytes;
}

void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  OutputFile(path).commit({static_cast<const std::byte*>(bytes), size});
}

}  // namespace platform
