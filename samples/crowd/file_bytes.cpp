#include "samples/crowd/file_bytes.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace crowd {

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("crowd: " + path.string() + " cannot be read; check the path");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
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
    throw std::runtime_error("crowd: " + path.string() +
                             " cannot be written; check the folder and the space left");
  }
  std::filesystem::rename(partial, path);
}

std::uint64_t hash_bytes(const void* bytes, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ULL;
  return hash;
}

}  // namespace crowd
