// The files of a scene and of the light round it, read with their names in every message.
#pragma once

#include <filesystem>

#include "bakers/images/scene_file.h"

namespace nook::tool {

// Throws ToolError (bad input) that names the file and, where it is one's fault, the texture. Without
// textures their colour factors stand for them.
bake::ProbeScene read_probe_scene(const std::filesystem::path& scene, const std::filesystem::path& light,
                                  bool textures, bake::LinkedFiles linked);

// Of a latitude-longitude map, the same.
bake::Environment read_map(const std::filesystem::path& path);

}  // namespace nook::tool
