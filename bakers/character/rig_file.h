// Rig files hold a user's corrections to the automatically recognised roles of a rig, as JSON.
#pragma once

#include <string>
#include <string_view>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// {"bones": {"IKBackLeg.L": {"role": "foot", "side": "left", "limb": 2, "parent": "BackLowerLeg.L"}}}
//
// Every entry of a bone is optional. "parent": null makes the bone a root. Fails with INVALID_ARGUMENT for
// text that is not such an object, and for unknown keys, roles and sides. Also fails for bone names that do
// not exist in the mesh or exist twice, and for parents that form a cycle.
RigCorrections read_rig(const SkinnedMesh& mesh, std::string_view text);

// Returns the corrections as one line of the same JSON, or an empty string if there are none.
std::string rig_text(const SkinnedMesh& mesh, const RigCorrections& corrections);

}  // namespace nook::bake
