// The owner, the mode and the attributes of a file, for the one that replaces it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace platform {

// Gives a new, empty file the owner, the mode and the extended attributes (access lists are among them) of an
// old one, as far as the system allows. Returns what a user may not expect, or nothing: other names of the
// old file keep the old content, the owner changes.
std::string take_attributes(int descriptor, const std::filesystem::path& old, const struct stat& there);

}  // namespace platform
