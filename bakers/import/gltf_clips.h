// Converts the animations of a glTF file to clips.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "bakers/import/clip.h"

namespace nook::bake {

// Leaves out the channels of morph targets, and clips that do not move a node. Adds a warning in both cases.
// Fails with BAD_FILE.
std::vector<Clip> read_clips(const tinygltf::Model& model, const NodeTree& nodes,
                             std::vector<std::string>& warnings);

}  // namespace nook::bake
