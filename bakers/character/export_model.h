// Converts a finished fit to the plain data of a CharacterModel.
#pragma once

#include <span>

#include "bakers/character/fit_state.h"
#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/bind_data.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// vertex_area and vertex_normal are from the rest pose. static_ao is the ray-traced AO of the rest pose, one
// value per welded vertex. Sets caster_weight of every sphere to 1. Does not set the blend weights; call
// fit_blend_weights for them.
CharacterModel export_model(const FitState& state, const SkinnedMesh& mesh,
                            std::span<const float> vertex_area, std::span<const Vec3> vertex_normal,
                            std::span<const float> static_ao);

// Converts a model back to a FitState, so that the bakers' code can fit it further or measure it.
FitState state_of_model(const CharacterModel& model);

// The part of the source's rest pose that a model stores. It lets hosts pass their own matrices and meshes.

// Returns bind matrices, skins, rest vertices that are spread over the bones, and vertices that are close to
// others. For a character from arrays, the bind matrices are the inverses of the bones' rest frames, and
// there are no skins.
BindData bind_data_of(const ImportedCharacter& character);

// Returns the positions and normals of the welded vertices in the rest pose.
RestSurface rest_surface_of(const SkinnedMesh& mesh);

}  // namespace nook::bake
