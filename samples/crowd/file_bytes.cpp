#include "file_bytes.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "platform/output_file.h"

namespace crowd {

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("crowd: " + path.string() + " cannot be read; check the path");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  platform::OutputFile(path).commit({static_cast<const std::byte*>(bytes), size});
}

std::uint64_t hash_bytes(const void* bytes, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ULL;
  return hash;
}

}  // namespace crowd
