#include "bakers/import/file_reader.h"

#include <fstream>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// Returns whether a relative path climbs above where it starts.
bool climbs(const std::string& relative) {
  const std::filesystem::path normal = std::filesystem::path(relative).lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

}  // namespace

std::vector<std::byte> read_file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Failure(NOOK_ERROR_BAD_FILE, "this is a folder (need a .glb or .gltf file)");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(NOOK_ERROR_BAD_FILE, "the file is missing or cannot be read");
  std::vector<std::byte> bytes;
  constexpr std::size_t block = std::size_t{1} << 22;
  std::size_t size = 0;
  // A pipe has no known size.
  const std::uintmax_t known = std::filesystem::is_regular_file(path, error) ? file_size(path, error) : block;
  while (file && size <= max_file_bytes) {
    bytes.resize(std::min<std::uintmax_t>(size == 0 ? known + 1 : size + block, max_file_bytes + 1));
    if (size == bytes.size()) break;
    file.read(reinterpret_cast<char*>(bytes.data()) + size, std::streamsize(bytes.size() - size));
    size += std::size_t(file.gcount());
  }
  if (size > max_file_bytes) throw Failure(NOOK_ERROR_BAD_FILE, "the file has more than 2 GiB");
  bytes.resize(size);
  return bytes;
}

tinygltf::FsCallbacks LinkedFileReader::callbacks() {
  tinygltf::FsCallbacks callbacks{};
  callbacks.user_data = this;
  callbacks.FileExists = [](const std::string& path, void* reader) {
    return static_cast<LinkedFileReader*>(reader)->may_open(path);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path,
                               void* reader) {
    return static_cast<LinkedFileReader*>(reader)->read(path, *out);
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  return callbacks;
}

// tinygltf looks for every name twice, in the folder given and in the current one, where nothing is to be
// read.
bool LinkedFileReader::may_open(const std::string& path) {
  std::string prefix = folder_;
  if (!prefix.ends_with('/')) prefix += '/';
  if (folder_.empty()) {
    fault_ = "external files are not read from memory; put the buffers into the file";
    return false;
  }
  if (!path.starts_with(prefix)) return false;
  const std::string name = path.substr(prefix.size());
  if (only_ && !only_->contains(name)) return false;
  const auto refuse = [&](const char* why) {
    fault_ = "names \"";
    fault_.append(name, 0, 120).append("\", ").append(why);
    return false;
  };
  if (linked_ == LinkedFiles::folder && climbs(name))
    return refuse("outside of its own folder; copy it there, or allow files outside");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return refuse("which is not there");
  if (!std::filesystem::is_regular_file(status)) return refuse("which is no regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > left_) return refuse("with which its files have more than 2 GiB");
  return true;
}

bool LinkedFileReader::read(const std::string& path, std::vector<unsigned char>& out) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > left_) return false;
  std::ifstream file(path, std::ios::binary);
  out.resize(std::size_t(size));
  if (!file || !file.read(reinterpret_cast<char*>(out.data()), std::streamsize(size))) {
    fault_ = "names a file that cannot be read: " + path.substr(0, 200);
    return false;
  }
  left_ -= size;
  return true;
}

}  // namespace nook::bake
