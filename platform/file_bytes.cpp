#include "platform/file_bytes.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw std::runtime_error("read_file: " + path.string() + " cannot be read; check the path");
  return bytes;
}

void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  std::filesystem::path partial = path;
  partial += ".part";
  std::ofstream file(partial, std::ios::binary);
  file.write(static_cast<const char*>(bytes), std::streamsize(size));
  file.close();
  if (!file) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw std::runtime_error("write_file: " + path.string() +
                             " cannot be written; check the folder and the space left");
  }
  std::filesystem::rename(partial, path);
}

}  // namespace platform
