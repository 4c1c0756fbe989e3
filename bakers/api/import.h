// The creation of characters with a choice that nook_bake.h has no field for, for the tool.
#pragma once

#include <nook/nook_bake.h>

#include "bakers/import/linked_files.h"

namespace nook::bake::api {

// As nook_bake_character_create(), which allows the files of LinkedFiles::folder.
nook_result create_character(const nook_bake_source_desc* desc, LinkedFiles linked,
                             nook_bake_character* out) noexcept;

}  // namespace nook::bake::api
