// Reads a glTF file and the files that it names, each within limits.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/linked_files.h"
#include "bakers/import/meshopt_views.h"

namespace nook::bake {

// Checks what a glTF file demands, before anything is allocated for it or another file is opened.

// Limits the file, the buffers that it declares, and the sum of the files that it names, each by itself.
constexpr std::uint64_t max_file_bytes = std::uint64_t{1} << 31;

struct GltfPreflight {
  // The buffers in other files: decoded URIs, and the bytes that are read. A file may be longer.
  std::map<std::string, std::uint64_t> buffer_files;
  std::vector<CompressedView> compressed_views;
  std::vector<std::size_t> matrix_beside_trs;  // nodes with two transforms; the parser drops one
  // The JSON that the parser gets; empty: the file's own. The parser decodes URIs in its own way. It needs
  // bytes even for buffers without a URI, such as the room for decompressed views, and for indices.
  std::string replacement;
  std::map<std::string, std::string> names;  // names of files, by their URI in the replacement
  std::set<std::string> rooms;               // URIs of the buffers without bytes
};

// Checks the JSON of a file. Fails with BAD_FILE on
//   - nesting deeper than 128 levels, or more than 2^24 values;
//   - versions other than 2.x, or a minimum above 2.0;
//   - extensions that the file requires and that we do not read; the message names a tool that removes them;
//   - buffers of more than max_file_bytes in all;
//   - members of a wrong type that decide shapes or poses (json_types.h).
// The parser reports anything else. The time is linear in the text.
GltfPreflight check_before_parsing(std::span<const std::byte> json, bool is_binary);

// Reads a file that a user named, up to max_file_bytes. It may be a pipe. Fails with BAD_FILE.
std::vector<std::byte> read_file_bytes(const std::filesystem::path& path);

// The reader that tinygltf opens files through. It opens regular files of at most max_file_bytes in all.
class LinkedFileReader {
 public:
  // An empty folder means that no file is opened. With only_buffers, files with other names are skipped
  // unopened. The preflight must outlive this object.
  LinkedFileReader(std::string folder, LinkedFiles linked, const GltfPreflight& preflight, bool only_buffers)
      : folder_(std::move(folder)), linked_(linked), preflight_(preflight), only_buffers_(only_buffers) {}

  // They point to this object.
  tinygltf::FsCallbacks callbacks();

  // Returns why the last unreadable file was refused; empty: no file was refused.
  const std::string& fault() const { return fault_; }

 private:
  bool may_open(const std::string& path);
  bool read(const std::string& path, std::vector<unsigned char>& out);
  bool is_room(const std::string& path) const;
  std::string name_of(const std::string& path) const;
  bool refuse(const std::string& name, const char* why);
  bool leaves_folder(const std::string& name) const;

  std::string folder_;
  LinkedFiles linked_;
  const GltfPreflight& preflight_;
  bool only_buffers_;
  std::uint64_t left_ = max_file_bytes;
  std::string fault_;
};

}  // namespace nook::bake
