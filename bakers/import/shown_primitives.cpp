#include "bakers/import/shown_primitives.h"

#include <algorithm>

#include "bakers/import/gltf_check.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/gltf_mesh.h"
#include "bakers/import/shown_nodes.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

int mode_of(const tinygltf::Primitive& primitive) {
  return primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
}

}  // namespace

bool has_triangles(const tinygltf::Primitive& primitive) {
  const int mode = mode_of(primitive);
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

// glTF 2.0, section 3.7.2.1 defines how strips and fans become triangles that all face the same way.
void append_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      std::size_t vertices, const std::string& what,
                      std::vector<std::array<std::uint32_t, 3>>& out) {
  std::vector<std::uint32_t> index;
  if (primitive.indices >= 0) {
    index = read_integers(model, primitive.indices, 1, what + ".indices").value;
    for (const std::uint32_t i : index)
      if (i >= vertices)
        throw Failure(NOOK_ERROR_BAD_FILE, "%s has index %u, but only %zu vertices", what.c_str(), i,
                      vertices);
  } else {
    for (std::uint32_t i = 0; i < vertices; ++i) index.push_back(i);
  }
  const std::size_t n = index.size();
  if (n > max_triangles - std::min(out.size(), max_triangles))
    throw Failure(NOOK_ERROR_BAD_FILE, "too many triangles (need at most %zu)", max_triangles);
  const int mode = mode_of(primitive);
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (n % 3 != 0)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s: its triangle list has %zu indices (need three per triangle)",
                    what.c_str(), n);
    for (std::size_t i = 0; i + 2 < n; i += 3) out.push_back({index[i], index[i + 1], index[i + 2]});
    return;
  }
  for (std::size_t i = 0; i + 2 < n; ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      out.push_back({index[i], index[i + 1 + i % 2], index[i + 2 - i % 2]});
    else
      out.push_back({index[i + 1], index[i + 2], index[0]});
  }
}

std::vector<std::string> for_each_shown_primitive(const tinygltf::Model& model,
                                                  const MeshSelection& selection,
                                                  const std::function<void(const ShownPrimitive&)>& visit) {
  const NodeTree nodes = read_nodes(model);
  ShownNodes chosen = choose_nodes(model, nodes, selection);
  const std::vector<Affine> world = default_world_transforms(nodes);
  std::size_t visited = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!chosen.shows(n)) continue;
    const int index = model.nodes[n].mesh;
    const tinygltf::Mesh& mesh = model.meshes[std::size_t(index)];
    ShownPrimitive shown;
    shown.node = std::uint32_t(n);
    shown.morph_weights = default_morph_weights(mesh, model.nodes[n]);
    for (const Affine& instance : mesh_instances(model, n)) {
      refuse_many_primitives(visited += mesh.primitives.size());
      shown.world_from_mesh = world[n] * instance;
      for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        shown.primitive = &mesh.primitives[p];
        shown.index = std::uint32_t(p);
        shown.what = "mesh " + std::to_string(index) + " primitive " + std::to_string(p);
        visit(shown);
      }
    }
  }
  std::vector<std::string> warnings = document_warnings(model);
  warnings.insert(warnings.end(), chosen.notes.begin(), chosen.notes.end());
  return warnings;
}

Floats read_positions(const tinygltf::Model& model, const ShownPrimitive& shown, std::size_t before) {
  const int accessor = attribute(*shown.primitive, "POSITION");
  if (accessor < 0) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no POSITION", shown.what.c_str());
  const std::string name = shown.what + ".POSITION";
  if (element_count(model, accessor, name) > max_file_vertices - before)
    throw Failure(NOOK_ERROR_BAD_FILE, "too many vertices (need at most %zu)", max_file_vertices);
  Floats position = read_floats(model, accessor, 3, name);
  add_morph_targets(model, *shown.primitive, shown.morph_weights, shown.what, position.value);
  return position;
}

}  // namespace nook::bake
