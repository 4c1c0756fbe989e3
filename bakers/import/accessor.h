// Reads glTF accessors and checks every bound, because tinygltf checks only some of them. The time is linear
// in the elements that are read.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nook::bake {

// Returns the number of elements that an accessor declares. Check it before you read, because an accessor
// without a buffer view costs no bytes in the file. Fails with BAD_FILE if the file has no accessor with this
// index.
std::size_t element_count(const tinygltf::Model& model, int accessor, const std::string& what);

// The components of all elements, one after another, as floats. Normalised integers become [0, 1] or [-1, 1];
// other integers keep their value. Sparse accessors are resolved. `what` names the accessor in messages.
// Fails with BAD_FILE.
struct Floats {
  std::vector<float> value;
  std::size_t count = 0;
  int components = 0;
};
Floats read_floats(const tinygltf::Model& model, int accessor, const std::string& what);

// Like read_floats, but the accessor must have this many components. Reads only the first `most` elements.
Floats read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& what,
                   std::size_t most = ~std::size_t{0});

// Unsigned integers: indices and joints.
struct Integers {
  std::vector<std::uint32_t> value;
  std::size_t count = 0;
  int components = 0;
};
Integers read_integers(const tinygltf::Model& model, int accessor, int components, const std::string& what);

}  // namespace nook::bake
