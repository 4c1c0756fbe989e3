#include "bakers/import/gltf_contents.h"

#include <algorithm>
#include <optional>

#include "bakers/import/accessor.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/gltf.h"
#include "bakers/import/gltf_clips.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/shown_nodes.h"
#include "bakers/import/shown_primitives.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

const char* text_of(NodeState state) {
  switch (state) {
    case NodeState::in:
      return "in";
    case NodeState::other_scene:
      return "out: not in the default scene";
    case NodeState::hidden:
      return "out: hidden";
    case NodeState::no_size:
      return "out: scaled to 0";
    case NodeState::lower_level:
      return "out: lower level of detail";
    case NodeState::not_chosen:
      return "out: not chosen";
    case NodeState::left_out:
      return "out: left out by name";
    case NodeState::no_mesh:
      break;
  }
  return "out: no mesh";
}

std::size_t triangles_of(const tinygltf::Primitive& primitive, std::size_t corners) {
  const bool is_list = primitive.mode < 0 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
  return is_list ? corners / 3 : corners > 2 ? corners - 2 : 0;
}

void add_mesh(const tinygltf::Model& model, std::size_t node, NodeState state,
              const ImportedCharacter* character, GltfContents& out) {
  const int index = model.nodes[node].mesh;
  std::int64_t number = -1;
  if (character) {
    const auto& nodes = character->node_of_primitive;
    const auto first = std::lower_bound(nodes.begin(), nodes.end(), std::uint32_t(node));
    if (first != nodes.end() && *first == node) number = first - nodes.begin();
  }
  for (const tinygltf::Primitive& primitive : model.meshes[std::size_t(index)].primitives) {
    ContentsMesh row;
    row.node = node_label(model, node);
    row.mesh = mesh_label(model, index);
    row.skin = model.nodes[node].skin;
    row.state = text_of(state);
    const int position = attribute(primitive, "POSITION");
    if (!has_triangles(primitive) || position < 0) {
      row.state = "out: no triangles";
      out.meshes.push_back(row);
      continue;
    }
    row.vertices = element_count(model, position, row.mesh + ".POSITION");
    row.triangles = triangles_of(
        primitive, primitive.indices < 0 ? row.vertices
                                         : element_count(model, primitive.indices, row.mesh + ".indices"));
    if (state == NodeState::in) {
      row.instances = mesh_instances(model, node).size();
      row.primitive = number;
      if (number >= 0)
        ++number;
      else if (character)
        row.state = "in if baked as a scene; a character bake leaves it out, because it follows no joint";
    }
    out.meshes.push_back(row);
  }
}

std::vector<ContentsSkin> skins_of(const tinygltf::Model& model, const std::vector<NodeState>& state) {
  std::vector<ContentsSkin> skins;
  std::vector<std::size_t> meshes(model.skins.size(), 0);
  for (std::size_t n = 0; n < state.size(); ++n)
    if (const int skin = model.nodes[n].skin;
        state[n] == NodeState::in && skin >= 0 && std::size_t(skin) < meshes.size())
      ++meshes[std::size_t(skin)];
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const std::string& name = model.skins[s].name;
    ContentsSkin skin;
    skin.name = name.empty() ? "skin_" + std::to_string(s) : name;
    skin.joints = model.skins[s].joints.size();
    skin.meshes = meshes[s];
    skins.push_back(skin);
  }
  return skins;
}

}  // namespace

GltfContents list_gltf(const std::filesystem::path& path, const ImportOptions& options) {
  const tinygltf::Model model = parse_gltf(
      read_file_bytes(path), {std::filesystem::absolute(path).parent_path().string(), options.linked});
  const NodeTree nodes = read_nodes(model);
  const std::vector<NodeState> state = node_states(model, nodes, options.meshes);
  GltfContents out;
  std::optional<ImportedCharacter> character;
  try {
    character = import_gltf(path, options);
    out.warnings = character->warnings;
  } catch (const Failure& failure) {
    out.warnings.push_back(std::string("cannot be baked as a character: ") + failure.what());
  }
  for (std::size_t n = 0; n < state.size(); ++n)
    if (state[n] != NodeState::no_mesh) add_mesh(model, n, state[n], character ? &*character : nullptr, out);
  out.skins = skins_of(model, state);
  std::vector<std::string> of_clips;
  for (const Clip& clip : read_clips(model, nodes, of_clips))
    out.clips.push_back({clip.name, clip.duration_s});
  return out;
}

}  // namespace nook::bake
