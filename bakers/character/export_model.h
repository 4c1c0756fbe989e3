// From a finished fit to the plain data that ships.
#pragma once

#include <span>

#include "bakers/character/fit_state.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// vertex_area and vertex_normal are of the rest pose; static_ao is its ray-traced AO, a value a welded
// vertex. caster_weight of every sphere is left at 1, blend weights are left to fit_blend_weights.
CharacterModel export_model(const FitState& state, const SkinnedMesh& mesh,
                            std::span<const float> vertex_area, std::span<const Vec3> vertex_normal,
                            std::span<const float> static_ao);

// The way back, so that a model can be fitted further or measured by the bakers' own code.
FitState state_of_model(const CharacterModel& model);

}  // namespace nook::bake
