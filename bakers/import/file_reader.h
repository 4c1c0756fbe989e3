// Reads a glTF file and the files that it names, each within limits.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bakers/import/gltf_preflight.h"
#include "bakers/import/linked_files.h"

namespace nook::bake {

// The bytes of a file that a user named, up to max_file_bytes; it may be a pipe. Fails with BAD_FILE.
std::vector<std::byte> read_file_bytes(const std::filesystem::path& path);

// The reader that tinygltf opens files through. It opens regular files of at most max_file_bytes in all.
class LinkedFileReader {
 public:
  // folder empty: no file is opened. only: decoded URIs; files with other names are passed over unopened;
  // null: all are opened.
  LinkedFileReader(std::string folder, LinkedFiles linked, const std::set<std::string>* only)
      : folder_(std::move(folder)), linked_(linked), only_(only) {}

  // They point to this object.
  tinygltf::FsCallbacks callbacks();

  // Returns why the last file that could not be read was refused; empty: none was.
  const std::string& fault() const { return fault_; }

 private:
  bool may_open(const std::string& path);
  bool read(const std::string& path, std::vector<unsigned char>& out);

  std::string folder_;
  LinkedFiles linked_;
  const std::set<std::string>* only_;
  std::uint64_t left_ = max_file_bytes;
  std::string fault_;
};

}  // namespace nook::bake
