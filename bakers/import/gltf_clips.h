// Animations of a glTF file as clips.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "bakers/import/clip.h"

namespace nook::bake {

// Leaves out channels of morph targets and clips that move no node, with a warning for both. Fails with
// BAD_FILE.
std::vector<Clip> read_clips(const tinygltf::Model& model, const NodeTree& nodes,
                             std::vector<std::string>& warnings);

}  // namespace nook::bake
