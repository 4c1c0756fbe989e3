// Decides which nodes of a file are in as geometry. Every import calls it, so that all bakes of a file see
// the same meshes.
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

// The reason that the mesh of a node is in or out. A node that is out still poses its children.
enum class NodeState : std::uint8_t {
  in,
  no_mesh,
  other_scene,  // not below a root of the default scene
  hidden,       // the node or an ancestor is invisible by KHR_node_visibility
  no_size,      // without a skin, and the node or an ancestor is scaled to 0 on all axes
  lower_level,  // of detail, by name or by MSFT_lod
  not_chosen,   // no pattern of MeshSelection::only matches
  left_out      // a pattern of MeshSelection::without matches
};

// The name of a node or mesh, or node_0, mesh_0 and so on without one.
std::string node_label(const tinygltf::Model& model, std::size_t node);
std::string mesh_label(const tinygltf::Model& model, int mesh);

// One state for each node. Where only lower levels would remain, the finest of them are in. Fails with
// BAD_FILE on indices out of range, and with INVALID_ARGUMENT on a pattern that matches no mesh of the scene.
// Linear in nodes times patterns.
std::vector<NodeState> node_states(const tinygltf::Model& model, const NodeTree& nodes,
                                   const MeshSelection& selection);

struct ShownNodes {
  std::vector<NodeState> state;    // of each node
  std::vector<std::string> notes;  // names what the file itself leaves out, one sentence for each reason

  bool shows(std::size_t node) const { return state[node] == NodeState::in; }
};

// As node_states. Fails with BAD_FILE where the scene has meshes and all of them are out, and where instances
// (EXT_mesh_gpu_instancing) would exceed the limits of vertices and triangles or belong to a skin.
ShownNodes choose_nodes(const tinygltf::Model& model, const NodeTree& nodes, const MeshSelection& selection);

// Returns the matrices from a node's mesh to the node: one for each instance, or else the identity. Fails
// with BAD_FILE.
std::vector<Affine> mesh_instances(const tinygltf::Model& model, std::size_t node);

// The number after LOD at the end of a name, in any case and behind the beginning, a space or one of _ . -;
// -1 without one.
int level_of_name(std::string_view name);

bool matches_pattern(std::string_view pattern, std::string_view name);

}  // namespace nook::bake
