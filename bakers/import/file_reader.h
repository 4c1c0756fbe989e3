// Reads a glTF file and the files that it refers to, and checks their sizes against limits.
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

// Checks the JSON of a glTF file before memory is allocated for it, and before other files are opened.

// This limit applies separately to the file, to the buffers that it declares, and to the sum of the files
// that it refers to.
constexpr std::uint64_t max_file_bytes = std::uint64_t{1} << 31;

struct GltfPreflight {
  // For each buffer in another file, its decoded URI and the number of bytes to read. The file may be longer.
  std::map<std::string, std::uint64_t> buffer_files;
  std::vector<CompressedView> compressed_views;
  std::vector<std::size_t>
      matrix_beside_trs;  // nodes with both a matrix and TRS; the parser drops one of the two
  // The JSON to pass to the parser. If empty, pass the JSON of the file. A replacement is necessary because
  // the parser decodes URIs in its own way. It also refuses indices without bytes, and buffers without bytes,
  // such as the buffers that will hold decompressed views.
  std::string replacement;
  std::map<std::string, std::string> names;  // maps each URI in `replacement` to the name of the file
  std::set<std::string> rooms;               // URIs of the buffers without bytes
};

// Checks the JSON of a file. Fails with BAD_FILE on
//   - nesting deeper than 128 levels, or more than 2^24 values;
//   - versions other than 2.x, or a minVersion above 2.0;
//   - required extensions that we do not support; the message names a tool that removes them;
//   - buffers that together exceed max_file_bytes;
//   - members that affect shapes or poses and have a wrong type (json_types.h).
// The parser reports all other errors. The time is linear in the text.
GltfPreflight check_before_parsing(std::span<const std::byte> json, bool is_binary);

// Reads a file that a user named, up to max_file_bytes. It may be a pipe. Fails with BAD_FILE.
std::vector<std::byte> read_file_bytes(const std::filesystem::path& path);

// tinygltf opens files through this reader. It opens only regular files, of at most max_file_bytes together.
class LinkedFileReader {
 public:
  // If `folder` is empty, no file is opened. If only_buffers is true, the reader opens only the files of
  // buffers and skips all others. The preflight must outlive this object.
  LinkedFileReader(std::string folder, LinkedFiles linked, const GltfPreflight& preflight, bool only_buffers)
      : folder_(std::move(folder)), linked_(linked), preflight_(preflight), only_buffers_(only_buffers) {}

  // The callbacks point to this object, so it must outlive them.
  tinygltf::FsCallbacks callbacks();

  // Returns the reason why the last unreadable file was refused, or an empty string if no file was refused.
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
