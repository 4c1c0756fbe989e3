// The triangles of one glTF primitive, whichever way it lists them.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace nook::bake {

// False for points and lines.
bool has_triangles(const tinygltf::Primitive& primitive);

// The accessor of an attribute, -1 without it.
int attribute(const tinygltf::Primitive& primitive, const std::string& name);

// Appends the triangles of a list, strip or fan of `vertices` vertices; `what` names the primitive in
// messages. Fails with BAD_FILE on an index out of range, and where `out` would exceed 2^25 triangles, which
// bounds memory on hostile input.
void append_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      std::size_t vertices, const std::string& what,
                      std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace nook::bake
