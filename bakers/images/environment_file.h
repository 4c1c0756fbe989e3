// Environment maps from image files. Compiled into the tool alone: the library would otherwise load
// OpenImageIO for nothing.
#pragma once

#include <filesystem>

#include "bakers/raytrace/environment.h"

namespace nook::bake::probe {

// A latitude-longitude map of floating-point radiance (.hdr, .exr), twice as wide as high, at most 16,384
// columns; negative values, which filters leave behind, become 0. Fails with BAD_FILE on anything else, also
// on values that are not finite; the message names the fault, and the caller adds the name of the file.
Environment read_environment(const std::filesystem::path& path);

}  // namespace nook::bake::probe
