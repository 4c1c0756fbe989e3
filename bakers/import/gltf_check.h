// Checks a parsed document against the specification. It refuses faults that change shapes or poses. It warns
// about faults that leave only one way to read the file.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace nook::bake {

// Fails with BAD_FILE on accessors of forbidden types for positions, joints, weights, indices, inverse bind
// matrices and animations. The time is linear in primitives, skins and channels.
void check_types(const tinygltf::Model& model);

// Returns one sentence for each kind of fault that the import repairs or ignores:
//   - rotations that are not unit quaternions;
//   - a matrix beside translation, rotation or scale;
//   - matrices of nodes and skins whose last row is not 0 0 0 1;
//   - indices that mean a primitive restart;
//   - bounds that do not match;
//   - attributes of forbidden types.
// This function never fails. The code that reads an accessor later reports if it is unreadable. Reads each
// accessor once, and at most 2^26 elements, so the time is linear in the file size.
std::vector<std::string> document_warnings(const tinygltf::Model& model);

}  // namespace nook::bake
