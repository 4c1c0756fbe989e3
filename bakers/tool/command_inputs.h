// The characters, scenes and maps that commands read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/images/scene_file.h"
#include "bakers/import/gltf.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

// Prints what an import left out or repaired, unless the command is quiet.
void print_warnings(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                    const CommonOptions& common);

// Prints the character's warnings. Failures name the file.
bake::ImportedCharacter read_character(const std::filesystem::path& path, const bake::ImportOptions& reading,
                                       const CommonOptions& common);

// Throws ToolError (bad arguments) that names the first clip of --clips that the character lacks and lists
// all that it has.
void require_clips(const std::vector<std::string>& wanted, const bake::ImportedCharacter& character);

// Throws ToolError (bad input) that names the file and, where it is one's fault, the texture. Without
// textures their colour factors stand for them. Prints the scene's warnings.
bake::ProbeScene read_probe_scene(const std::filesystem::path& scene, const std::filesystem::path& light,
                                  bool textures, const bake::ImportOptions& reading,
                                  const CommonOptions& common);

// Reads a latitude-longitude map. Throws ToolError (bad input) that names the file.
bake::Environment read_map(const std::filesystem::path& path);

}  // namespace nook::tool
