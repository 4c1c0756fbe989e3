// Reads data that a bake's import does not keep: texture coordinates, textures, and props.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samples/showcase/stage.h"

namespace showcase {

// Returns the triangles of a prop, moved by `world_from_file`. Appends its texture to `textures` unless an
// equal texture is already there. Throws std::runtime_error with a text that names the file.
std::vector<Mesh> read_prop(const std::filesystem::path& glb, const glm::mat4& world_from_file,
                            std::vector<Texture>& textures);

// The texture coordinates of a character, in the order of the file's vertices, and its texture. Both are
// missing if the character has no texture.
struct CharacterSkin {
  std::vector<glm::vec2> uvs;
  int texture = no_texture;
};
CharacterSkin read_skin(const std::filesystem::path& glb, const std::vector<std::string>& without,
                        std::vector<Texture>& textures);

}  // namespace showcase
