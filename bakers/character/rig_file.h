// Rig files: a user's corrections of what was understood of a rig, as JSON.
#pragma once

#include <string>
#include <string_view>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// {"bones": {"IKBackLeg.L": {"role": "foot", "side": "left", "limb": 2, "parent": "BackLowerLeg.L"}}}
// Every entry of a bone may be left out; "parent": null makes a root. Fails with INVALID_ARGUMENT for text
// that is not such an object, and for unknown keys, roles and sides. It also refuses bones that the mesh
// lacks or has twice, and parents that form a ring.
RigCorrections read_rig(const SkinnedMesh& mesh, std::string_view text);

// The same as one line; empty without corrections.
std::string rig_text(const SkinnedMesh& mesh, const RigCorrections& corrections);

}  // namespace nook::bake
