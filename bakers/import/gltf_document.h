// Parses the bytes of a glTF document, and makes its node tree.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/linked_files.h"
#include "bakers/import/node_tree.h"

namespace nook::bake {

// Images are never decoded. With `skip`, image files are not opened. With `keep`, tinygltf::Image::image
// contains the encoded bytes of the image at the URI. It is empty if the image could not be read.
enum class Images { skip, keep };

// The folder with the files that a document refers to.
struct FileAccess {
  std::string folder;  // empty: no file is opened
  LinkedFiles linked = LinkedFiles::folder;
};

// Decompresses views and primitives, and checks that positions, joints, weights, indices and animations have
// types that glTF allows. Fails with BAD_FILE. The time is linear in the file and in its decompressed size.
tinygltf::Model parse_gltf(std::span<const std::byte> bytes, const FileAccess& files,
                           Images images = Images::skip);

// Fails with BAD_FILE if the nodes have a cycle, a node has two parents, an index is out of range, or a
// transform is not finite. The time is linear in the nodes.
NodeTree read_nodes(const tinygltf::Model& model);

}  // namespace nook::bake
