// The primitives that the default scene of a file shows, each with its place in the world, for readers of
// shapes that do not move.
#pragma once

#include <tiny_gltf.h>

#include <functional>
#include <string>
#include <vector>

#include "bakers/import/accessor.h"
#include "sdk/src/core/affine.h"

namespace nook::bake {

struct ShownPrimitive {
  const tinygltf::Primitive* primitive = nullptr;  // of the model
  std::string what;                                // names it in messages
  Affine world_from_mesh;
  std::vector<double> morph_weights;  // empty where all are 0
};

// One at a time, because a small file may show a mesh of many primitives by many nodes. In the order of
// nodes. Fails with BAD_FILE on indices out of range.
void for_each_shown_primitive(const tinygltf::Model& model,
                              const std::function<void(const ShownPrimitive&)>& visit);

// The positions of a primitive in the space of its mesh, 3 floats for each vertex, with the morph targets at
// their weights. A shape has a limit of vertices, of which `before` belong to other primitives. Fails with
// BAD_FILE.
Floats read_positions(const tinygltf::Model& model, const ShownPrimitive& shown, std::size_t before);

}  // namespace nook::bake
