#include "platform/file_bytes.h"

#include <cstdint>

#include "platform/input_file.h"
#include "platform/output_file.h"

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_input(path, UINT64_MAX, {});
  const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
  return {first, first + bytes.size()};
}

void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  OutputFile(path).commit({static_cast<const std::byte*>(bytes), size});
}

}  // namespace platform
