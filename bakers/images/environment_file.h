// Environment maps from image files. Compiled into the tool alone: the library would otherwise load
// OpenImageIO for nothing.
#pragma once

#include <filesystem>

#include "bakers/raytrace/environment.h"

namespace nook::bake::probe {

// A latitude-longitude map of floating-point radiance (.hdr, .exr), twice as wide as high, at most 16,384
// columns. Negative values, which filters leave behind, become 0 where they add up to 1 % of the others or
// less. Fails with BAD_FILE on anything else, also on values that are not finite or above raytrace's
// max_radiance; the message names the fault, and the caller adds the name of the file.
Environment read_environment(const std::filesystem::path& path);

}  // namespace nook::bake::probe
