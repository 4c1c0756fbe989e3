// The types that glTF 2.0 allows for what an accessor is used for.
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

// True where the specification, with KHR_mesh_quantization if the file uses it, allows the accessor's element
// and component type.
bool has_allowed_type(const tinygltf::Model& model, const tinygltf::Accessor& accessor, AccessorUse use);

// Fails with BAD_FILE if the type is not allowed. `what` names the use, as in `mesh 0 primitive 1.JOINTS_0`.
// Does nothing if there is no such accessor, because readers report it.
void require_allowed_type(const tinygltf::Model& model, int accessor, AccessorUse use,
                          const std::string& what);

// Returns text such as "VEC4 of FLOAT", for messages.
std::string type_name(const tinygltf::Accessor& accessor);

}  // namespace nook::bake
