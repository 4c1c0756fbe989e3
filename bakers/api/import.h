// The import of characters with a choice that nook_bake_character.h has no argument for, for the tool.
#pragma once

#include <nook/nook_bake_character.h>

#include "bakers/import/linked_files.h"

namespace nook::bake::api {

// As nook_bake_import_gltf(), which allows the files of LinkedFiles::folder.
nook_result import_character(const char* path, LinkedFiles linked, nook_bake_character* out) noexcept;

}  // namespace nook::bake::api
