// The characters, scenes and maps that commands read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/images/scene_file.h"
#include "bakers/import/gltf.h"
#include "bakers/measure/character/rig_report.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

// Prints the warnings of an import, which say what it left out or repaired. Prints nothing if the command is
// quiet.
void print_warnings(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                    const CommonOptions& common);

// Reads a character and prints its warnings. Failures name the file.
bake::ImportedCharacter read_character(const std::filesystem::path& path, const bake::ImportOptions& reading,
                                       const CommonOptions& common);

// Reads a rig file (bakers/character/rig_file.h). Returns no corrections for an empty path. Throws ToolError
// that names the file.
bake::RigCorrections read_rig_file(const std::filesystem::path& path, const bake::SkinnedMesh& mesh);

// If a clip of --clips does not exist, throws ToolError (bad arguments) that names the first such clip and
// lists the clips of the character.
void require_clips(const std::vector<std::string>& wanted, const bake::ImportedCharacter& character);

// Reads a scene and prints its warnings. If textures are not read, uses only the colour factors of materials.
// Throws ToolError (bad input) that names the file. If a texture causes the error, the message also names the
// texture.
bake::ProbeScene read_probe_scene(const std::filesystem::path& scene, const std::filesystem::path& light,
                                  bool textures, const bake::ImportOptions& reading,
                                  const CommonOptions& common);

// Reads a latitude-longitude map. Throws ToolError (bad input) that names the file.
bake::Environment read_map(const std::filesystem::path& path);

}  // namespace nook::tool
