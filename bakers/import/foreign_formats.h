// Files that are given in place of glTF by mistake.
#pragma once

#include <cstddef>
#include <span>

namespace nook::bake {

// Returns words such as "an FBX file" for a known format that is not glTF, by its first bytes; NULL for
// others.
const char* foreign_format(std::span<const std::byte> bytes);

}  // namespace nook::bake
