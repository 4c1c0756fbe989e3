// The object behind the handle nook_material.
#pragma once

#include <nook/nook_material.h>

#include "sdk/src/api/handles.h"
#include "sdk/src/material/tables.h"

struct nook_material_s : nook::RefCounted {
  // Makes the tables from `loaded`. Does not keep the compressed data of `loaded`.
  nook_material_s(nook_context_s* made_by, const nook::material::Material& loaded,
                  const nook::material::ModeForm& form);

  nook_material_info info{};  // struct_size is not set
  nook::material::MaterialTables tables;
};
