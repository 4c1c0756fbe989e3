// The demands of a glTF file, checked before anything is allocated for it or another file is opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>

namespace nook::bake {

// Of a file, of the buffers that it declares, and of the files that it names, added up each.
constexpr std::uint64_t max_file_bytes = std::uint64_t{1} << 31;

struct GltfPreflight {
  std::set<std::string> buffer_files;  // URIs of the buffers in other files, decoded
};

// Looks at the JSON of a file. Fails with BAD_FILE on nesting deeper than 128 levels, on more than 2^24
// values, on extensions that the file requires and nobody reads here, which are named with the tool that
// takes them out, and on buffers of more than max_file_bytes in all. Anything else that is wrong is left to
// the parser.
GltfPreflight check_before_parsing(std::span<const std::byte> json);

}  // namespace nook::bake
