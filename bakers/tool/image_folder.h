// The folder of --images and the names in it.
#pragma once

#include <filesystem>
#include <string>

namespace nook::tool {

// Makes the folder before the work begins; an empty path stands for none. Throws ToolError.
void make_image_folder(const std::filesystem::path& folder);

// A name that stands in a file, as the beginning of a file's name: slashes and control characters become
// underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::tool
