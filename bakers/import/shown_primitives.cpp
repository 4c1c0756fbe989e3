#include "bakers/import/shown_primitives.h"

#include "bakers/import/gltf_document.h"
#include "bakers/import/morph_targets.h"
#include "bakers/import/primitive_triangles.h"
#include "bakers/import/validate.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

void for_each_shown_primitive(const tinygltf::Model& model,
                              const std::function<void(const ShownPrimitive&)>& visit) {
  const NodeTree nodes = read_nodes(model);
  const std::vector<int> meshes = shown_meshes(model, nodes);
  const std::vector<Affine> world = default_world_transforms(nodes);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (meshes[n] < 0) continue;
    const tinygltf::Mesh& mesh = model.meshes[std::size_t(meshes[n])];
    ShownPrimitive shown;
    shown.world_from_mesh = world[n];
    shown.morph_weights = default_morph_weights(mesh, model.nodes[n]);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      shown.primitive = &mesh.primitives[p];
      shown.what = "mesh " + std::to_string(meshes[n]) + " primitive " + std::to_string(p);
      visit(shown);
    }
  }
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
