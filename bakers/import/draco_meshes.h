// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include <tiny_gltf.h>

namespace nook::bake {

// True if this build reads Draco: CMake found the library, and NOOK_DRACO is on.
bool reads_draco();

// Decompresses the primitives into buffers that it appends, and points their attributes and indices to new
// accessors. A primitive that also has uncompressed data keeps them. Fails with BAD_FILE; the message names
// the primitive. The time is linear in the decompressed data, which 2 GiB bound.
void decompress_draco(tinygltf::Model& model);

}  // namespace nook::bake
