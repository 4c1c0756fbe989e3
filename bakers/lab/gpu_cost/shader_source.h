// Assembles the text of a shader as the library does, with includes, version line and defines. Compiles it
// with the reference compiler.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nook::lab {

enum class Stage { vertex, fragment, compute };

std::string file_text(const std::filesystem::path& path);

// Replaces each line `#include "path"` by the text of that file. Paths are relative to `root`. Each file is
// inserted at most once per shader, as in sdk/src/gl/embed_shaders.cmake.
std::string expand_includes(const std::filesystem::path& root, const std::string& text);

// Puts the version line of sdk/src/gl/shader_program.cpp and the defines in front of an expanded text.
std::string with_version(Stage stage, const std::string& defines, const std::string& text);

// Expands macros, resolves conditions and removes comments. The text must begin with a version line.
std::string preprocess(Stage stage, const std::string& text);

// Compiles Vulkan GLSL. `what` is the name of the shader in messages.
std::vector<std::uint32_t> compile_spirv(Stage stage, const std::string& text, const std::string& what);

}  // namespace nook::lab
