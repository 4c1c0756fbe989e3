// Morph targets at the weights that a file gives them by default: they are part of the shape that it shows.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace nook::bake {

// The weights of a mesh as a node shows it: the node's own, else the mesh's; empty where they are all 0.
std::vector<double> default_morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node);

// Adds the weighted displacements of a primitive's targets to its positions, 3 floats for each vertex. Fails
// with BAD_FILE on weights that are not finite and targets that do not fit.
void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       const std::vector<double>& weights, const std::string& what,
                       std::vector<float>& position);

}  // namespace nook::bake
