// The object behind the handle nook_material.
#pragma once

#include <nook/nook_material.h>

#include "sdk/src/api/handles.h"
#include "sdk/src/material/tables.h"

struct nook_material_s : nook::RefCounted {
  // Does not keep the compressed numbers.
  nook_material_s(nook_context_s* made_by, const nook::material::Material& loaded,
                  const nook::material::ModeForm& form);

  nook_material_info info{};  // without struct_size
  nook::material::MaterialTables tables;
};
