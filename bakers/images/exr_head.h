// The check of an EXR file's head before a library reads it: OpenEXR takes the memory that an attribute
// claims, up to 2 GB, before it looks whether the file has as much.
#pragma once

#include <filesystem>

namespace nook::bake {

// Throws Failure(NOOK_ERROR_BAD_FILE) where `path` begins like an EXR file and an attribute of its heads is
// longer than what follows in the file or of another size than its type, or where it says more rows than the
// file has places for; `what` begins the message. A file of another kind, or one that cannot
// be opened, passes: its reader names the fault.
void check_exr_head(const char* what, const std::filesystem::path& path);

}  // namespace nook::bake
