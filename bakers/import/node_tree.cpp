#include "bakers/import/node_tree.h"

#include <unordered_map>
#include <unordered_set>

#include "sdk/src/core/failure.h"

namespace nook::bake {

void sort_parents_first(NodeTree& tree) {
  // Limits the depth. The code walks up to the root for every bone, so the time for a very long chain would
  // be quadratic in its length.
  constexpr std::uint32_t max_depth = 4096;
  const std::size_t count = tree.size();
  std::vector<std::uint32_t> depth(count, 0);
  std::vector<std::vector<std::uint32_t>> children(count);
  tree.order.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (tree.nodes[i].parent < 0)
      tree.order.push_back(i);
    else
      children[tree.nodes[i].parent].push_back(i);
  }
  for (std::size_t next = 0; next < tree.order.size(); ++next)
    for (const std::uint32_t child : children[tree.order[next]]) {
      depth[child] = depth[tree.order[next]] + 1;
      if (depth[child] > max_depth)
        throw Failure(NOOK_ERROR_BAD_FILE, "nodes are nested deeper than %u levels", max_depth);
      tree.order.push_back(child);
    }
  if (tree.order.size() != count)
    throw Failure(NOOK_ERROR_BAD_FILE, "%zu nodes form a cycle (need a tree); repair the file",
                  count - tree.order.size());
}

Affine default_local(const Node& node) {
  return node.matrix ? *node.matrix : to_affine(node.local);
}

std::vector<Affine> world_transforms(const NodeTree& tree, const std::vector<Trs>& locals) {
  std::vector<Affine> world(tree.size());
  for (const std::uint32_t i : tree.order) {
    const Node& node = tree.nodes[i];
    const Affine local = node.matrix ? *node.matrix : to_affine(locals[i]);
    world[i] = node.parent < 0 ? local : world[node.parent] * local;
  }
  return world;
}

std::vector<Affine> default_world_transforms(const NodeTree& tree) {
  return world_transforms(tree, default_locals(tree));
}

std::vector<Trs> default_locals(const NodeTree& tree) {
  std::vector<Trs> locals;
  locals.reserve(tree.size());
  for (const Node& node : tree.nodes) locals.push_back(node.local);
  return locals;
}

std::vector<std::string> unique_names(const std::vector<std::string>& names, std::string_view stem) {
  // Names from the file take precedence over the names made here.
  std::unordered_set<std::string> taken(names.begin(), names.end());
  std::unordered_set<std::string> used;
  std::unordered_map<std::string, std::size_t> next_suffix;
  std::vector<std::string> out;
  out.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string base = names[i].empty() ? std::string(stem) + "_" + std::to_string(i) : names[i];
    std::string name = base;
    const bool must_differ =
        names[i].empty() ? taken.count(name) > 0 || used.count(name) > 0 : used.count(name) > 0;
    if (must_differ) {
      std::size_t& suffix = next_suffix.try_emplace(base, 2).first->second;
      do name = base + "_" + std::to_string(suffix++);
      while (taken.count(name) > 0 || used.count(name) > 0);
    }
    used.insert(name);
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace nook::bake
