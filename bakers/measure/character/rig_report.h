// Tables of what a bake recognises in a rig.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rig_file.h"
#include "bakers/import/gltf.h"

namespace nook::measure {

// Returns a row for each bone: its name, role, side, limb, partner, and its parent in the body plan. `moved`
// is true if this parent differs from the bone's parent in the rig. `vertices` is the number of vertices that
// have their largest weight for this bone.
nlohmann::ordered_json bone_rows(const bake::SkinnedMesh& mesh, const bake::RigCorrections& corrections);

// Returns one row. It has the body plan that automatic poses use, the fraction of the mesh's edges that 60
// automatic poses tear (see torn_edges.h), and the fraction that the file's own clips tear.
nlohmann::ordered_json torn_edge_rows(const bake::ImportedCharacter& character,
                                      const bake::RigCorrections& corrections, std::uint64_t seed);

}  // namespace nook::measure
