// The nodes of a file: their default local transforms and their parents, without skins.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/core/affine.h"

namespace nook::bake {

struct Node {
  std::string name;
  std::int32_t parent = -1;
  Trs local;                     // default pose
  std::optional<Affine> matrix;  // used instead of `local`; clips never animate such a node
};

struct NodeTree {
  std::vector<Node> nodes;           // in the order of the file
  std::vector<std::uint32_t> order;  // every node once, parents before children

  std::size_t size() const { return nodes.size(); }
};

// Fills tree.order. Fails with BAD_FILE when the parents make a cycle or an endless chain.
void sort_parents_first(NodeTree& tree);

Affine default_local(const Node& node);

// Returns the world matrices of all nodes. `locals` contains one local transform for each node. It is ignored
// for nodes with a matrix.
std::vector<Affine> world_transforms(const NodeTree& tree, const std::vector<Trs>& locals);
std::vector<Affine> default_world_transforms(const NodeTree& tree);

// Returns the default local transforms of all nodes. Sampling a clip begins with them.
std::vector<Trs> default_locals(const NodeTree& tree);

// Makes names unique and not empty, so that they can be looked up.

// An empty name becomes `stem` and its index ("clip_0"). A name that already occurred gets the first free
// suffix "_2", "_3", ...
std::vector<std::string> unique_names(const std::vector<std::string>& names, std::string_view stem);

}  // namespace nook::bake
