// The model of a mesh of less detail, from the bake of the full mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/import/gltf.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

struct LodTask {
  std::size_t auto_poses = 200;
  std::size_t samples_per_clip = 8;
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
};

// `lod` has the bones of the model in the same order, as a mesh of the same rig has. The result has the
// spheres, key points, levels and casters of the model, and vertices that are fitted to ray tracing of `lod`
// in automatic poses and those of its clips. The stage is JobStage::raytrace and counts poses. Throws
// Failure: BAD_FILE (no model, other bones), CANCELLED.
BakedFile bake_lod_file(const ImportedCharacter& lod, std::span<const std::byte> model_bytes,
                        const LodTask& task, const StageReport& progress);

}  // namespace nook::bake
