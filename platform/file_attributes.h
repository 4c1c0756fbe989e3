// Copies the owner, mode and extended attributes of a file to the file that replaces it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace platform {

// Gives a new, empty file the owner, mode and extended attributes (including access lists) of an old file, as
// far as the system allows. Returns a note for the user if other names (hard links) keep the old content, or
// if the owner changes. Otherwise returns an empty text.
std::string take_attributes(int descriptor, const std::filesystem::path& old, const struct stat& there);

}  // namespace platform
