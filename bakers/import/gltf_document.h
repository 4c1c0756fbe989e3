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

// Images are not decoded. skip: those in files of their own are not opened. keep: what URIs name is in
// tinygltf::Image::image, as encoded; empty where it could not be read.
enum class Images { skip, keep };

// Where the files lie that a document names.
struct FileAccess {
  std::string folder;  // empty: no file is opened
  LinkedFiles linked = LinkedFiles::folder;
};

// Compressed views and primitives come decompressed, and positions, joints, weights, indices and animations
// have types that glTF allows. Fails with BAD_FILE. The time is linear in the file and in what it
// decompresses to.
tinygltf::Model parse_gltf(std::span<const std::byte> bytes, const FileAccess& files,
                           Images images = Images::skip);

// Fails with BAD_FILE on cycles, second parents, indices out of range and transforms that are not finite. The
// time is linear in the nodes.
NodeTree read_nodes(const tinygltf::Model& model);

}  // namespace nook::bake
