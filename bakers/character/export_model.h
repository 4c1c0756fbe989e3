// From a finished fit to the plain data that ships.
#pragma once

#include <span>

#include "bakers/character/fit_state.h"
#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/bind_data.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// vertex_area and vertex_normal are from the rest pose. static_ao is the rest pose's ray-traced AO, one value
// per welded vertex. caster_weight of every sphere is left at 1, blend weights are left to fit_blend_weights.
CharacterModel export_model(const FitState& state, const SkinnedMesh& mesh,
                            std::span<const float> vertex_area, std::span<const Vec3> vertex_normal,
                            std::span<const float> static_ao);

// The way back, so that a model can be fitted further or measured by the bakers' own code.
FitState state_of_model(const CharacterModel& model);

// The part of its source's rest pose that a model keeps, so that hosts can hand over their own matrices and
// meshes.

// Bind matrices, skins, rest vertices that are spread over the bones, and vertices that are close to others.
// Bones of a character from arrays have the inverses of their rest frames, and no skins.
BindData bind_data_of(const ImportedCharacter& character);

// Positions and normals of the welded vertices in the rest pose.
RestSurface rest_surface_of(const SkinnedMesh& mesh);

}  // namespace nook::bake
