// Bent normals for a model that is already baked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/import/gltf.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

struct BentTask {
  std::size_t auto_poses = 48;
  std::size_t samples_per_clip = 3;
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
};

// Adds blocked vectors to the model of `character`, fitted to ray tracing in automatic poses and those of the
// clips that the model was fitted to, or of all clips where it has no recipe. What the model has besides
// stays as it is. The stage is NOOK_BAKE_STAGE_RAYTRACE and counts poses. Throws Failure: BAD_FILE (no model,
// or that of another character), CANCELLED.
BakedFile bake_bent_file(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                         const BentTask& task, const StageReport& progress);

}  // namespace nook::bake
