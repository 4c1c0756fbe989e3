// Lists the primitives that the default scene of a file shows, each with its place in the world. It serves
// readers of shapes that do not move. It also reads the triangles of a primitive from lists, strips and fans.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bakers/import/accessor.h"
#include "bakers/import/import_options.h"
#include "sdk/src/core/affine.h"

namespace nook::bake {

// Bounds memory on hostile input.
inline constexpr std::size_t max_triangles = std::size_t{1} << 25;

// False for points and lines.
bool has_triangles(const tinygltf::Primitive& primitive);

// Returns the accessor of an attribute; -1 without it.
int attribute(const tinygltf::Primitive& primitive, const std::string& name);

// Appends the triangles of a list, strip or fan of `vertices` vertices; `what` names the primitive in
// messages. Fails with BAD_FILE on an index out of range, and where `out` would exceed max_triangles.
void append_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      std::size_t vertices, const std::string& what,
                      std::vector<std::array<std::uint32_t, 3>>& out);

struct ShownPrimitive {
  const tinygltf::Primitive* primitive = nullptr;  // of the model
  std::uint32_t node = 0, index = 0;               // the node, and the index in its mesh
  std::string what;                                // names it in messages
  Affine world_from_mesh;
  std::vector<double> morph_weights;  // empty where all are 0
};

// Visits the primitives of the chosen nodes (choose_nodes) in the order of nodes; the instances of a mesh
// follow one another. It reads one at a time, because a small file may show a mesh of many primitives by many
// nodes. Returns the warnings of the document and the notes of choose_nodes, and fails as choose_nodes does.
std::vector<std::string> for_each_shown_primitive(const tinygltf::Model& model,
                                                  const MeshSelection& selection,
                                                  const std::function<void(const ShownPrimitive&)>& visit);

// Returns the positions of a primitive in the space of its mesh, 3 floats for each vertex, with morph targets
// applied at their weights. A shape has a limit of vertices, and `before` vertices belong to other
// primitives. Fails with BAD_FILE.
Floats read_positions(const tinygltf::Model& model, const ShownPrimitive& shown, std::size_t before);

}  // namespace nook::bake
