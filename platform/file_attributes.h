// Copies the owner, mode and attributes of a file to the file that replaces it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace platform {

// Gives a new, empty file the owner, mode and extended attributes (access lists included) of an old one, as
// far as the system allows. Returns a note on what the user may not expect, or an empty text: other names of
// the old file keep the old content, or the owner changes.
std::string take_attributes(int descriptor, const std::filesystem::path& old, const struct stat& there);

}  // namespace platform
