// Recognises files of other formats that a user passes instead of glTF by mistake.
#pragma once

#include <cstddef>
#include <span>

namespace nook::bake {

// Recognises known formats other than glTF by the first bytes, and returns a phrase such as "an FBX file".
// Returns NULL for all other data.
const char* foreign_format(std::span<const std::byte> bytes);

}  // namespace nook::bake
