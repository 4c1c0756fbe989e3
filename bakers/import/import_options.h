// The options of every import of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "bakers/import/linked_files.h"

namespace nook::bake {

// Patterns for names of nodes and meshes: * stands for any text and ? for any character. Case matters. A node
// without a name is node_0, node_1 and so on, by its index; a mesh is mesh_0, mesh_1.
struct MeshSelection {
  std::vector<std::string> only;     // empty: all but lower levels of detail
  std::vector<std::string> without;  // left out of these
};

struct ImportOptions {
  LinkedFiles linked = LinkedFiles::folder;
  MeshSelection meshes = {};
};

}  // namespace nook::bake
