// Knows which types glTF 2.0 allows for each use of an accessor.
#pragma once

#include <tiny_gltf.h>

#include <string>

namespace nook::bake {

enum class AccessorUse {
  position,
  normal,
  tangent,
  texture_coordinates,
  colour,
  joints,
  weights,
  indices,
  morph_position,
  morph_normal,
  morph_tangent,
  inverse_bind,
  key_times,
  translation_or_scale,
  rotation,
};

// Returns true if the specification allows the accessor's element and component type for this use. Includes
// the types of KHR_mesh_quantization if the file uses that extension.
bool has_allowed_type(const tinygltf::Model& model, const tinygltf::Accessor& accessor, AccessorUse use);

// Fails with BAD_FILE if the type is not allowed. `what` names the use, as in `mesh 0 primitive 1.JOINTS_0`.
// Does nothing if the accessor does not exist, because the code that reads it reports that.
void require_allowed_type(const tinygltf::Model& model, int accessor, AccessorUse use,
                          const std::string& what);

// Returns text such as "VEC4 of FLOAT", for messages.
std::string type_name(const tinygltf::Accessor& accessor);

}  // namespace nook::bake
