// Pictures of --images.
#pragma once

#include <filesystem>
#include <string>

#include "raytrace/picture.h"

namespace nook::cli {

// Makes the folder of --images before the work begins; an empty path stands for none. Throws ToolError.
void make_image_folder(const std::filesystem::path& folder);

void write_png(const std::filesystem::path& path, const bake::Picture& picture);

// A name that stands in a file, as the beginning of a file's name: slashes and control characters become underscores.
std::string as_file_name(const std::string& name);

}  // namespace nook::cli
