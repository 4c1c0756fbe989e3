// Reads and writes rig files. A rig file is JSON with a user's corrections to the roles that Nook recognised
// in a rig.
#pragma once

#include <string>
#include <string_view>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// {"bones": {"IKBackLeg.L": {"role": "foot", "side": "left", "limb": 2, "parent": "BackLowerLeg.L"}}}
//
// Every entry of a bone is optional. "parent": null makes the bone a root. Fails with INVALID_ARGUMENT if the
// text is not such an object, and for unknown keys, roles and sides. Also fails for bone names that the mesh
// does not have or has twice, and for parents that form a cycle.
RigCorrections read_rig(const SkinnedMesh& mesh, std::string_view text);

// Returns the corrections as one line of the same JSON, or an empty string if there are none.
std::string rig_text(const SkinnedMesh& mesh, const RigCorrections& corrections);

}  // namespace nook::bake
