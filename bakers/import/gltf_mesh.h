// Appends the mesh primitives of a glTF file to a mesh, in file order.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "bakers/import/gltf_skeleton.h"
#include "bakers/import/weld.h"

namespace nook::bake {

// Applies morph targets with their default weights in the file, because they are part of the visible shape.

// Returns the morph weights of a node's mesh. Uses the weights of the node if it has any, otherwise the
// weights of the mesh. Returns an empty array if all weights are 0.
std::vector<double> default_morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node);

// Adds the weighted displacements of a primitive's targets to its positions, 3 floats for each vertex. Fails
// with BAD_FILE if a weight is not finite, or if a target does not match the primitive.
void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       const std::vector<double>& weights, const std::string& what,
                       std::vector<float>& position);

// Fails with BAD_FILE if `count` exceeds 2^20. A primitive counts once for each node and instance that shows
// it, because each of them costs time, even if the primitive has no vertices.
void refuse_many_primitives(std::size_t count);

// Counters over all primitives, used for the warnings.
struct MeshRepairs {
  std::size_t primitives = 0;
  std::size_t sums_not_one = 0;
  double worst_sum = 1;
  std::size_t skinned = 0;          // vertices
  std::size_t without_weights = 0;  // vertices that are now bound to their first joint
  std::size_t negative_weights = 0;
  std::size_t too_many_bones = 0;
  std::size_t not_triangles = 0;  // primitives of points or lines, which are left out
  std::size_t morphed = 0;        // meshes with default morph weights, which were applied
  std::size_t with_targets = 0;   // meshes with morph targets
};

// A mesh node and its transform to rest space.
struct PlacedMesh {
  const tinygltf::Node& node;
  const MeshBinding& binding;
  bool node_mirrors = false;  // the determinant of its global transform is negative; only used for skins
};

// Appends all triangle primitives of a node's mesh with their fronts outside (turns_round). The node must
// have a mesh. If the node has a skin, reads joints and weights. Otherwise all vertices follow
// binding.bone[0]. Fails with BAD_FILE. The time is linear in the appended vertices and indices, and in the
// primitives. A file may show at most 2^20 primitives.
void append_mesh(const tinygltf::Model& model, const PlacedMesh& placed, FileMesh& out, MeshRepairs& repairs);

// Fails with BAD_FILE if more than 1 % of the skinned vertices have no weights. So many missing weights mean
// a fault, and not a few overlooked vertices.
void add_warnings(const MeshRepairs& repairs, std::vector<std::string>& warnings);

}  // namespace nook::bake
