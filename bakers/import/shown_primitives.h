// Lists the primitives that the default scene of a file shows, each with its transform to world space.
// Readers of static shapes use this list. Also reads the triangles of a primitive from lists, strips and
// fans.
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

// Limits the memory that a malicious file can cause Nook to allocate.
inline constexpr std::size_t max_triangles = std::size_t{1} << 25;

// Returns false for points and lines.
bool has_triangles(const tinygltf::Primitive& primitive);

// Returns the accessor of an attribute, or -1 if the primitive does not have the attribute.
int attribute(const tinygltf::Primitive& primitive, const std::string& name);

// Appends the triangles of a list, strip or fan of `vertices` vertices; `what` names the primitive in
// messages. Fails with BAD_FILE if an index is out of range, or if `out` would exceed max_triangles.
void append_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      std::size_t vertices, const std::string& what,
                      std::vector<std::array<std::uint32_t, 3>>& out);

struct ShownPrimitive {
  const tinygltf::Primitive* primitive = nullptr;  // a primitive of the model
  std::uint32_t node = 0, index = 0;               // the node, and the index in its mesh
  std::string what;                                // name of the primitive in messages
  Affine world_from_mesh;
  std::vector<double> morph_weights;  // empty if all are 0
};

// Visits the primitives of the chosen nodes (choose_nodes) in the order of nodes. The instances of a mesh are
// visited one after another. Only one primitive is in memory at a time, because a small file may show a mesh
// of many primitives through many nodes. Returns the warnings of the document and the notes of choose_nodes,
// and fails as choose_nodes does.
std::vector<std::string> for_each_shown_primitive(const tinygltf::Model& model,
                                                  const MeshSelection& selection,
                                                  const std::function<void(const ShownPrimitive&)>& visit);

// Returns the positions of a primitive in the space of its mesh, 3 floats for each vertex, with morph targets
// applied. `before` is the number of vertices of other primitives in the shape; it counts towards the limit
// of vertices. Fails with BAD_FILE.
Floats read_positions(const tinygltf::Model& model, const ShownPrimitive& shown, std::size_t before);

}  // namespace nook::bake
