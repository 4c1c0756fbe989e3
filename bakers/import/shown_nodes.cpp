#include "bakers/import/shown_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bakers/import/accessor.h"
#include "bakers/import/shown_primitives.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr const char* visibility_extension = "KHR_node_visibility";
constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";
constexpr const char* levels_extension = "MSFT_lod";

const tinygltf::Value* extension_of(const tinygltf::Node& node, const char* name) {
  const auto found = node.extensions.find(name);
  return found == node.extensions.end() || !found->second.IsObject() ? nullptr : &found->second;
}

bool is_letter(char c, char lower) {
  return c == lower || c == lower - 'a' + 'A';
}

// Returns the number of bytes of the first UTF-8 character, or 1 if the bytes are not UTF-8.
std::size_t character_bytes(std::string_view text) {
  std::size_t n = 1;
  while (n < text.size() && n < 4 && (static_cast<unsigned char>(text[n]) & 0xc0) == 0x80) ++n;
  return n;
}

// Returns a list of names from which the user can choose a node. It contains each name once, and at most ten
// names.
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t most = 10;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    text += text.empty() ? "\"" : ", \"";
    text += names[i].substr(0, 80) + "\"";
  }
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + (count == 1 ? one : many);
}

// Marks each node for which `begins` is true, and all below it.
std::vector<bool> subtrees(const NodeTree& nodes, const std::function<bool(std::size_t)>& begins) {
  std::vector<bool> marked(nodes.size(), false);
  for (const std::uint32_t i : nodes.order) {
    const std::int32_t parent = nodes.nodes[i].parent;
    marked[i] = (parent >= 0 && marked[std::size_t(parent)]) || begins(i);
  }
  return marked;
}

// Returns the nodes of the default scene, or all nodes if the file has no scene.
std::vector<bool> nodes_of_scene(const tinygltf::Model& model, const NodeTree& nodes) {
  if (model.scenes.empty()) return std::vector<bool>(nodes.size(), true);
  const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
  if (static_cast<std::size_t>(scene) >= model.scenes.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "the default scene is %d, but the file has only %zu", scene,
                  model.scenes.size());
  std::vector<bool> is_root(nodes.size(), false);
  for (const int root : model.scenes[std::size_t(scene)].nodes) {
    if (root < 0 || static_cast<std::size_t>(root) >= nodes.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "scene %d refers to node %d, but the file has only %zu", scene, root,
                    nodes.size());
    is_root[std::size_t(root)] = true;
  }
  return subtrees(nodes, [&](std::size_t n) { return is_root[n]; });
}

bool is_hidden(const tinygltf::Model& model, std::size_t node) {
  const tinygltf::Value* extension = extension_of(model.nodes[node], visibility_extension);
  if (!extension || !extension->Has("visible")) return false;
  const tinygltf::Value& visible = extension->Get("visible");
  if (!visible.IsBool())
    throw Failure(NOOK_ERROR_BAD_FILE, "node %zu (\"%s\"): %s.visible is not true or false", node,
                  node_label(model, node).c_str(), visibility_extension);
  return !visible.Get<bool>();
}

// glTF 2.0, section 3.5.3: a renderer may leave out nodes that are scaled to 0 on all axes.
bool has_no_size(const Node& node) {
  if (!node.matrix) return node.local.scale == std::array<double, 3>{0, 0, 0};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      if (node.matrix->m[4 * r + c] != 0) return false;
  return true;
}

// Returns the levels from MSFT_lod. The node that has the extension is the finest level, and lists the nodes
// of the other levels.
std::vector<int> levels_by_extension(const tinygltf::Model& model) {
  std::vector<int> level(model.nodes.size(), 0);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Value* extension = extension_of(model.nodes[n], levels_extension);
    if (!extension || !extension->Has("ids") || !extension->Get("ids").IsArray()) continue;
    const tinygltf::Value& ids = extension->Get("ids");
    for (std::size_t i = 0; i < ids.ArrayLen(); ++i) {
      const tinygltf::Value& id = ids.Get(int(i));
      const int node = id.IsNumber() ? id.GetNumberAsInt() : -1;
      if (node < 0 || std::size_t(node) >= model.nodes.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "node %zu: %s refers to node %d, but the file has only %zu", n,
                      levels_extension, node, model.nodes.size());
      if (std::size_t(node) != n) level[std::size_t(node)] = int(i) + 1;
    }
  }
  return level;
}

// Returns the level of each node with a mesh; 0 is the finest. It is the larger of two levels: from MSFT_lod,
// and from names (of the node and its mesh, else of the nearest ancestor).
std::vector<int> levels(const tinygltf::Model& model, const NodeTree& nodes) {
  const std::vector<int> named_by_extension = levels_by_extension(model);
  std::vector<int> level(nodes.size(), 0), inherited(nodes.size(), 0), extended(nodes.size(), 0);
  for (const std::uint32_t n : nodes.order) {
    const std::int32_t parent = nodes.nodes[n].parent;
    const int own = level_of_name(nodes.nodes[n].name);
    inherited[n] = own >= 0 ? own : parent >= 0 ? inherited[std::size_t(parent)] : 0;
    extended[n] = named_by_extension[n];
    if (extended[n] == 0 && parent >= 0) extended[n] = extended[std::size_t(parent)];
    const int mesh = model.nodes[n].mesh;
    const bool has_mesh = mesh >= 0 && std::size_t(mesh) < model.meshes.size();
    const int of_mesh = has_mesh ? level_of_name(model.meshes[std::size_t(mesh)].name) : -1;
    const int by_name = own < 0 && of_mesh >= 0 ? of_mesh : std::max(inherited[n], of_mesh);
    level[n] = std::max(extended[n], by_name);
  }
  return level;
}

bool matches(const tinygltf::Model& model, std::size_t node, const std::string& pattern) {
  return matches_pattern(pattern, node_label(model, node)) ||
         matches_pattern(pattern, mesh_label(model, model.nodes[node].mesh));
}

bool matches_any(const tinygltf::Model& model, std::size_t node, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return matches(model, node, pattern); });
}

void require_matches(const tinygltf::Model& model, const std::vector<NodeState>& state,
                     const std::vector<std::string>& patterns, const char* purpose) {
  std::vector<std::size_t> with_mesh;
  for (std::size_t n = 0; n < state.size(); ++n)
    if (state[n] != NodeState::no_mesh && state[n] != NodeState::other_scene) with_mesh.push_back(n);
  for (const std::string& pattern : patterns) {
    const auto fits = [&](std::size_t n) { return matches(model, n, pattern); };
    if (std::any_of(with_mesh.begin(), with_mesh.end(), fits)) continue;
    std::vector<std::string> names;
    for (const std::size_t n : with_mesh) {
      names.push_back(node_label(model, n));
      names.push_back(mesh_label(model, model.nodes[n].mesh));
    }
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "no mesh and no node with a mesh is named \"%s\", which you asked %s; the file has %s",
                  pattern.substr(0, 120).c_str(), purpose,
                  names.empty() ? "no mesh" : listed(std::move(names)).c_str());
  }
}

// If all meshes that could be included are lower levels, includes the finest of them.
void keep_finest(const std::vector<int>& level, std::vector<NodeState>& state) {
  int finest = 0;
  for (std::size_t n = 0; n < state.size(); ++n) {
    if (state[n] == NodeState::in) return;
    if (state[n] == NodeState::lower_level) finest = finest == 0 ? level[n] : std::min(finest, level[n]);
  }
  for (std::size_t n = 0; n < state.size(); ++n)
    if (state[n] == NodeState::lower_level && level[n] == finest) state[n] = NodeState::in;
}

std::vector<std::string> names_of(const tinygltf::Model& model, const std::vector<NodeState>& state,
                                  NodeState wanted) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < state.size(); ++n)
    if (state[n] == wanted) names.push_back(node_label(model, n));
  return names;
}

struct Reason {
  NodeState state;
  const char* text;  // completes "a mesh is ..."
};
constexpr std::array<Reason, 5> reasons = {{{NodeState::hidden, "hidden by KHR_node_visibility"},
                                            {NodeState::no_size, "scaled to 0"},
                                            {NodeState::lower_level, "a lower level of detail"},
                                            {NodeState::not_chosen, "not chosen by name (--mesh)"},
                                            {NodeState::left_out, "left out by name (--without)"}}};

// Fails if the scene has meshes, but none of them is included.
void require_any(const tinygltf::Model& model, const std::vector<NodeState>& state) {
  if (std::find(state.begin(), state.end(), NodeState::in) != state.end()) return;
  std::string why;
  for (const Reason& reason : reasons)
    if (const auto names = names_of(model, state, reason.state); !names.empty())
      why += (why.empty() ? "" : "; ") + std::to_string(names.size()) + " " + reason.text + " (" +
             listed(names) + ")";
  if (!why.empty())
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "no triangles, because every mesh of the scene is left out: %s; show a mesh, or choose one by name",
        why.c_str());
}

void note_levels(const tinygltf::Model& model, const std::vector<NodeState>& state,
                 const std::vector<int>& level, bool is_chosen, std::vector<std::string>& notes) {
  if (const auto names = names_of(model, state, NodeState::lower_level); !names.empty())
    notes.push_back(counted(names.size(), " mesh is a lower level of detail and was left out: ",
                            " meshes are lower levels of detail and were left out: ") +
                    listed(names) + "; to bake one, choose it by name (--mesh)");
  if (is_chosen) return;
  std::vector<std::string> taken;
  for (std::size_t n = 0; n < state.size(); ++n)
    if (state[n] == NodeState::in && level[n] > 0) taken.push_back(node_label(model, n));
  if (!taken.empty())
    notes.push_back(
        "the names of all meshes mark them as lower levels of detail, so the finest level was used: " +
        listed(taken));
}

void note_other_scenes(const tinygltf::Model& model, const std::vector<NodeState>& state,
                       std::vector<std::string>& notes) {
  if (const auto names = names_of(model, state, NodeState::other_scene); !names.empty())
    notes.push_back(counted(names.size(), " mesh is not in the default scene and was left out: ",
                            " meshes are not in the default scene and were left out: ") +
                    listed(names));
}

// Returns true if the base colour is fully transparent, so that no renderer shows it. Textures only multiply
// it.
bool is_transparent(const tinygltf::Model& model, int material) {
  if (material < 0 || std::size_t(material) >= model.materials.size()) return false;
  const tinygltf::Material& m = model.materials[std::size_t(material)];
  const std::vector<double>& colour = m.pbrMetallicRoughness.baseColorFactor;
  return m.alphaMode == "BLEND" && colour.size() == 4 && colour[3] == 0;
}

// Collision hulls and click targets are often hidden in this way.
void note_transparent(const tinygltf::Model& model, const std::vector<NodeState>& state,
                      std::vector<std::string>& notes) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < state.size(); ++n) {
    if (state[n] != NodeState::in) continue;
    const auto& primitives = model.meshes[std::size_t(model.nodes[n].mesh)].primitives;
    if (!primitives.empty() &&
        std::all_of(primitives.begin(), primitives.end(),
                    [&](const tinygltf::Primitive& p) { return is_transparent(model, p.material); }))
      names.push_back(node_label(model, n));
  }
  if (names.empty()) return;
  const std::string first = names.front();
  notes.push_back(
      counted(
          names.size(),
          " mesh has a material with alpha 0, but the bake treats it as solid, so it darkens other meshes: ",
          " meshes have materials with alpha 0, but the bake treats them as solid, so they darken other "
          "meshes: ") +
      listed(names) + "; leave out a mesh that is never visible: --without \"" + first + "\"");
}

struct InstanceAttributes {
  std::string what;
  int translation = -1, rotation = -1, scale = -1;
  std::size_t count = 1;
  bool is_used() const { return translation >= 0 || rotation >= 0 || scale >= 0; }
};

InstanceAttributes instance_attributes(const tinygltf::Model& model, std::size_t node) {
  InstanceAttributes out;
  const tinygltf::Value* extension = extension_of(model.nodes[node], instancing_extension);
  if (!extension || !extension->Has("attributes") || !extension->Get("attributes").IsObject()) return out;
  out.what =
      "node " + std::to_string(node) + " (\"" + node_label(model, node) + "\"): " + instancing_extension;
  const tinygltf::Value& attributes = extension->Get("attributes");
  std::size_t counted_attributes = 0;
  const auto find = [&](const char* name) {
    if (!attributes.Has(name)) return -1;
    const tinygltf::Value& value = attributes.Get(name);
    const int accessor = value.IsNumber() ? value.GetNumberAsInt() : -1;
    const std::size_t count = element_count(model, accessor, out.what + "." + name);
    if (counted_attributes++ > 0 && count != out.count)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s has attributes for %zu and for %zu instances (need the same number)",
                    out.what.c_str(), out.count, count);
    out.count = count;
    return accessor;
  };
  out.translation = find("TRANSLATION");
  out.rotation = find("ROTATION");
  out.scale = find("SCALE");
  return out;
}

// Sums over the triangle primitives of a mesh.
struct MeshSize {
  std::size_t vertices = 0, corners = 0;
};

MeshSize size_of(const tinygltf::Model& model, int mesh) {
  MeshSize size;
  for (const tinygltf::Primitive& primitive : model.meshes[std::size_t(mesh)].primitives) {
    const int position = attribute(primitive, "POSITION");
    if (!has_triangles(primitive) || position < 0) continue;
    const std::size_t vertices = element_count(model, position, mesh_label(model, mesh) + ".POSITION");
    size.vertices += vertices;
    size.corners += primitive.indices < 0
                        ? vertices
                        : element_count(model, primitive.indices, mesh_label(model, mesh) + ".indices");
  }
  return size;
}

// Checks the totals before any mesh is read, because a small file can contain very many instances.
void check_instances(const tinygltf::Model& model, const std::vector<NodeState>& state) {
  constexpr std::size_t max_instances = std::size_t{1} << 20;
  std::size_t instances = 0;
  double vertices = 0, corners = 0;
  for (std::size_t n = 0; n < state.size(); ++n) {
    if (state[n] != NodeState::in || !extension_of(model.nodes[n], instancing_extension)) continue;
    const InstanceAttributes attributes = instance_attributes(model, n);
    if (!attributes.is_used()) continue;
    if (model.nodes[n].skin >= 0)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s repeats a mesh with a skin, which Nook does not read; export each instance as a node",
                    attributes.what.c_str());
    const MeshSize size = size_of(model, model.nodes[n].mesh);
    instances += std::min(attributes.count, max_instances + 1);
    vertices += double(attributes.count) * double(size.vertices);
    corners += double(attributes.count) * double(size.corners);
    if (instances > max_instances || vertices > double(max_file_vertices) || corners > 3.0 * max_triangles)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s repeats its mesh too often: %zu instances of %zu vertices each (need at most %zu "
                    "instances, %zu vertices and %zu triangles in the whole file); leave some out",
                    attributes.what.c_str(), attributes.count, size.vertices, max_instances,
                    max_file_vertices, max_triangles);
  }
}

// The state and the level of detail of each node.
struct States {
  std::vector<NodeState> state;
  std::vector<int> level;
};

States states_of(const tinygltf::Model& model, const NodeTree& nodes, const MeshSelection& selection) {
  const std::vector<bool> in_scene = nodes_of_scene(model, nodes);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (in_scene[n] && model.nodes[n].mesh >= 0 && std::size_t(model.nodes[n].mesh) >= model.meshes.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "node %zu refers to mesh %d, but the file has only %zu", n,
                    model.nodes[n].mesh, model.meshes.size());
  const auto has_mesh = [&](std::size_t n) {
    return model.nodes[n].mesh >= 0 && std::size_t(model.nodes[n].mesh) < model.meshes.size();
  };
  const std::vector<bool> hidden = subtrees(nodes, [&](std::size_t n) { return is_hidden(model, n); });
  const std::vector<bool> no_size =
      subtrees(nodes, [&](std::size_t n) { return has_no_size(nodes.nodes[n]); });
  States out{std::vector<NodeState>(nodes.size(), NodeState::in), levels(model, nodes)};
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    NodeState& state = out.state[n];
    if (!has_mesh(n))
      state = NodeState::no_mesh;
    else if (!in_scene[n])
      state = NodeState::other_scene;
    else if (hidden[n])
      state = NodeState::hidden;
    else if (no_size[n] && model.nodes[n].skin < 0)
      state = NodeState::no_size;
    else if (!selection.only.empty() && !matches_any(model, n, selection.only))
      state = NodeState::not_chosen;
    else if (matches_any(model, n, selection.without))
      state = NodeState::left_out;
    else if (selection.only.empty() && out.level[n] > 0)
      state = NodeState::lower_level;
  }
  require_matches(model, out.state, selection.only, "to keep (--mesh)");
  require_matches(model, out.state, selection.without, "to leave out (--without)");
  keep_finest(out.level, out.state);
  return out;
}

}  // namespace

std::string node_label(const tinygltf::Model& model, std::size_t node) {
  const std::string& name = model.nodes[node].name;
  return name.empty() ? "node_" + std::to_string(node) : name;
}

std::string mesh_label(const tinygltf::Model& model, int mesh) {
  const std::string& name = model.meshes[std::size_t(mesh)].name;
  return name.empty() ? "mesh_" + std::to_string(mesh) : name;
}

int level_of_name(std::string_view name) {
  std::size_t first = name.size();
  while (first > 0 && name[first - 1] >= '0' && name[first - 1] <= '9') --first;
  const std::string_view digits = name.substr(first);
  if (digits.empty() || first < 3) return -1;
  if (!is_letter(name[first - 3], 'l') || !is_letter(name[first - 2], 'o') ||
      !is_letter(name[first - 1], 'd'))
    return -1;
  if (first > 3 && std::string_view("_.- ").find(name[first - 4]) == std::string_view::npos) return -1;
  int level = 0;
  for (const char digit : digits) level = std::min(10 * level + (digit - '0'), 1000000);
  return level;
}

bool matches_pattern(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, star_name = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_name = n;
    } else if (p < pattern.size() && pattern[p] == '?') {
      ++p;
      n += character_bytes(name.substr(n));
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      star_name += character_bytes(name.substr(star_name));
      p = star + 1;
      n = star_name;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<NodeState> node_states(const tinygltf::Model& model, const NodeTree& nodes,
                                   const MeshSelection& selection) {
  return states_of(model, nodes, selection).state;
}

ShownNodes choose_nodes(const tinygltf::Model& model, const NodeTree& nodes, const MeshSelection& selection) {
  States states = states_of(model, nodes, selection);
  require_any(model, states.state);
  check_instances(model, states.state);
  ShownNodes out;
  out.state = std::move(states.state);
  for (const Reason& reason : {reasons[0], reasons[1]})
    if (const auto names = names_of(model, out.state, reason.state); !names.empty())
      out.notes.push_back(counted(names.size(), " mesh is ", " meshes are ") + reason.text +
                          (names.size() == 1 ? " and was left out: " : " and were left out: ") +
                          listed(names));
  note_other_scenes(model, out.state, out.notes);
  note_levels(model, out.state, states.level, !selection.only.empty(), out.notes);
  note_transparent(model, out.state, out.notes);
  return out;
}

std::vector<Affine> mesh_instances(const tinygltf::Model& model, std::size_t node) {
  const InstanceAttributes attributes = instance_attributes(model, node);
  if (!attributes.is_used()) return {Affine{}};
  const auto read = [&](int accessor, int components, const char* name) {
    return accessor < 0 ? std::vector<float>()
                        : read_floats(model, accessor, components, attributes.what + "." + name).value;
  };
  const std::vector<float> translation = read(attributes.translation, 3, "TRANSLATION");
  const std::vector<float> rotation = read(attributes.rotation, 4, "ROTATION");
  const std::vector<float> scale = read(attributes.scale, 3, "SCALE");
  std::vector<Affine> out;
  out.reserve(attributes.count);
  for (std::size_t i = 0; i < attributes.count; ++i) {
    Trs trs;
    if (!translation.empty()) std::copy_n(translation.begin() + long(3 * i), 3, trs.translation.begin());
    if (!rotation.empty()) std::copy_n(rotation.begin() + long(4 * i), 4, trs.rotation.begin());
    if (!scale.empty()) std::copy_n(scale.begin() + long(3 * i), 3, trs.scale.begin());
    double square = 0;
    for (const double q : trs.rotation) square += q * q;
    for (double& q : trs.rotation) q /= std::sqrt(square);
    const Affine place = to_affine(trs);
    if (!is_finite(place))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s: instance %zu has a transform that is not finite, or a rotation of length 0",
                    attributes.what.c_str(), i);
    out.push_back(place);
  }
  return out;
}

}  // namespace nook::bake
