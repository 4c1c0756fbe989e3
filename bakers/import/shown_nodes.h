// Decides which nodes of a file are included as geometry. Every import uses this code, so that all bakes of a
// file use the same meshes.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/import/node_tree.h"

namespace nook::bake {

// Says whether the mesh of a node is included, or why it is left out. Even if the mesh is left out, the node
// still transforms its children.
enum class NodeState : std::uint8_t {
  in,
  no_mesh,
  other_scene,  // not below a root of the default scene
  hidden,       // the node or an ancestor is invisible by KHR_node_visibility
  no_size,      // the node has no skin, and it or an ancestor is scaled to 0 on all axes
  lower_level,  // a lower level of detail, according to its name or MSFT_lod
  not_chosen,   // no pattern of MeshSelection::only matches
  left_out      // a pattern of MeshSelection::without matches
};

// Returns the name of a node or mesh. If it has no name, returns node_0, mesh_0 and so on.
std::string node_label(const tinygltf::Model& model, std::size_t node);
std::string mesh_label(const tinygltf::Model& model, int mesh);

// Returns one state for each node. If only lower levels of detail would remain, includes the finest of them.
// Fails with BAD_FILE if an index is out of range. Fails with INVALID_ARGUMENT if a pattern matches no mesh
// of the scene. The time is O(nodes * patterns).
std::vector<NodeState> node_states(const tinygltf::Model& model, const NodeTree& nodes,
                                   const MeshSelection& selection);

struct ShownNodes {
  std::vector<NodeState> state;    // one state per node
  std::vector<std::string> notes;  // what the file itself hides or excludes, one sentence for each reason

  bool shows(std::size_t node) const { return state[node] == NodeState::in; }
};

// Calls node_states, and fails in the same cases. Also fails with BAD_FILE if the scene has meshes but all of
// them are left out. Instances (EXT_mesh_gpu_instancing) cause BAD_FILE if they exceed the limits of vertices
// and triangles, or if a skinned mesh has them.
ShownNodes choose_nodes(const tinygltf::Model& model, const NodeTree& nodes, const MeshSelection& selection);

// Returns the matrices from the space of a node's mesh to the node. There is one for each instance. Without
// instances, returns the identity. Fails with BAD_FILE.
std::vector<Affine> mesh_instances(const tinygltf::Model& model, std::size_t node);

// Returns the number after "LOD" at the end of a name, or -1 if there is none. "LOD" may be in upper or lower
// case. It must be at the beginning of the name, or after a space or one of _ . -
int level_of_name(std::string_view name);

bool matches_pattern(std::string_view pattern, std::string_view name);

}  // namespace nook::bake
