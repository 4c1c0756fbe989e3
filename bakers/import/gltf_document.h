// Bytes to a parsed glTF document, and its node tree.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/linked_files.h"
#include "bakers/import/node_tree.h"

namespace nook::bake {

// Images are not decoded. skip: image files are not opened. keep: tinygltf::Image::image holds the encoded
// bytes that URIs name; empty if they could not be read.
enum class Images { skip, keep };

// The folder of the files that a document names.
struct FileAccess {
  std::string folder;  // empty: no file is opened
  LinkedFiles linked = LinkedFiles::folder;
};

// Decompresses views and primitives, and checks that positions, joints, weights, indices and animations have
// types that glTF allows. Fails with BAD_FILE. The time is linear in the file and in its decompressed size.
tinygltf::Model parse_gltf(std::span<const std::byte> bytes, const FileAccess& files,
                           Images images = Images::skip);

// Fails with BAD_FILE on cycles, second parents, indices out of range and transforms that are not finite. The
// time is linear in the nodes.
NodeTree read_nodes(const tinygltf::Model& model);

}  // namespace nook::bake
