// What an import reads of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "bakers/import/linked_files.h"

namespace nook::bake {

// Patterns of names of nodes and of meshes: * stands for any text and ? for any character; upper and lower
// case differ. A node without a name is node_0, node_1 and so on, by its index; a mesh is mesh_0, mesh_1.
struct MeshSelection {
  std::vector<std::string> only;     // empty: all but lower levels of detail
  std::vector<std::string> without;  // of those, what is left out
};

struct ImportOptions {
  LinkedFiles linked = LinkedFiles::folder;
  MeshSelection meshes = {};
};

}  // namespace nook::bake
