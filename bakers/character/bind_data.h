// The part of its source's rest pose that a model keeps, so that hosts can hand over their own matrices and
// meshes.
#pragma once

#include "bakers/import/gltf.h"
#include "sdk/src/character/bind_data.h"

namespace nook::bake {

// Bind matrices, skins, and rest vertices that are spread over the bones. Bones of a character from arrays
// have the inverses of their rest frames, and no skins.
BindData bind_data_of(const ImportedCharacter& character);

// Positions and normals of the welded vertices in the rest pose.
RestSurface rest_surface_of(const SkinnedMesh& mesh);

}  // namespace nook::bake
