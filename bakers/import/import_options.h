// The options that all imports of glTF files share.
#pragma once

#include <string>
#include <vector>

#include "bakers/import/linked_files.h"

namespace nook::bake {

// Patterns for names of nodes and meshes: * stands for any text and ? for any character. Case matters. A node
// without a name is called node_0, node_1 and so on, after its index. A mesh without a name is called mesh_0,
// mesh_1 and so on.
struct MeshSelection {
  std::vector<std::string> only;     // patterns to include; empty: all except lower levels of detail
  std::vector<std::string> without;  // patterns to leave out of the included ones
};

struct ImportOptions {
  LinkedFiles linked = LinkedFiles::folder;
  MeshSelection meshes = {};
};

}  // namespace nook::bake
