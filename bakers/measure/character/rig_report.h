// Tables of what a bake understands of a rig.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rig_file.h"
#include "bakers/import/gltf.h"

namespace nook::measure {

// A row for each bone: its name, role, side, limb, partner and parent in the body. moved is true if this
// parent differs from the rig's. vertices counts the vertices that the bone moves most.
nlohmann::ordered_json bone_rows(const bake::SkinnedMesh& mesh, const bake::RigCorrections& corrections);

// One row: by which plan automatic poses move the body, and the share of the mesh's edges that 60 of them
// tear (torn_edges.h), beside the share that the file's own clips tear.
nlohmann::ordered_json torn_edge_rows(const bake::ImportedCharacter& character,
                                      const bake::RigCorrections& corrections, std::uint64_t seed);

}  // namespace nook::measure
