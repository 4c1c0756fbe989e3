// Decompresses primitives that use KHR_draco_mesh_compression.
#pragma once

#include <tiny_gltf.h>

namespace nook::bake {

// Returns true if this build can read Draco. It can if CMake found the library and NOOK_DRACO is on.
bool reads_draco();

// Decompresses the primitives into new buffers of the model. Their attributes and indices then refer to new
// accessors. If a primitive also has uncompressed data, it is not changed. Fails with BAD_FILE; the message
// names the primitive. The time is linear in the size of the decompressed data, which is at most 2 GiB.
void decompress_draco(tinygltf::Model& model);

}  // namespace nook::bake
