// The rule that tells Make and Ninja what a bake reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/tool/command_files.h"

namespace nook::tool {

// Returns the inputs, the buffers that their glTF files name, with images also the images that they name, and
// the files of folders that are read.
std::vector<std::filesystem::path> files_read(const CommandFiles& files, bool with_images);

// Returns "output: file file ...", with the escapes that Ninja reads. Throws ToolError (bad arguments) for a
// name that the rule cannot hold, because it has a line break.
std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& read);

// Returns the first name that Ninja 1.11 cuts off, at a quote for example: it misses the file then, and bakes
// every time. No escape helps. Empty: none.
std::string name_that_ninja_cuts(const std::filesystem::path& output,
                                 const std::vector<std::filesystem::path>& read);

}  // namespace nook::tool
