// Makes the depfile rule that tells Make and Ninja which files a bake reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/tool/command_files.h"

namespace nook::tool {

// Returns all files that a bake reads: the inputs, the buffers that glTF inputs refer to, and the files of
// folders that are read. If with_images is true, also returns the images that glTF inputs refer to.
std::vector<std::filesystem::path> files_read(const CommandFiles& files, bool with_images);

// Returns "output: file file ...", with the escapes that Ninja reads. Throws ToolError (bad arguments) for a
// name with a line break, which a rule cannot contain.
std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& read);

// Returns the first name that Ninja 1.11 would cut off, for example at a quote. Such characters cannot be
// escaped. Ninja would not find the file and would therefore bake every time. Returns an empty string if
// there is no such name.
std::string name_that_ninja_cuts(const std::filesystem::path& output,
                                 const std::vector<std::filesystem::path>& read);

}  // namespace nook::tool
