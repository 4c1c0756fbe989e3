// Bakes that start from the model of a baked character. They add bent normals to it, or make the model of a
// mesh with less detail.
#pragma once

#include <nook/nook_bake.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/import/gltf.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Reads the baked model of an imported character, for bakes that extend it.

// Reads the character's baked model. Throws Failure: BAD_FILE (no model, or a model of another character),
// FILE_VERSION.
CharacterModel model_of_character(std::span<const std::byte> bytes, const ImportedCharacter& character);

struct BentTask {
  std::uint32_t auto_poses = 48;
  std::uint32_t samples_per_clip = 3;
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) for a number out of its range.
BentTask bent_task_of(const nook_bake_bent_desc& desc);

// Returns the identity of a call of bake_bent_file for the model in these bytes.
BakeIdentity identify_bent(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                           const BentTask& task);

// Adds occluded directions to the model of `character`. They are fitted to ray tracing in automatic poses and
// in poses of clips. The clips are the ones that the model was fitted to, or all clips if the model has no
// recipe. If `identity` is not empty, the recipe of the model stores it. Nothing else in the model is
// changed. Progress reports the stage JobStage::raytrace and counts poses. Throws Failure: BAD_FILE (a recipe
// of another character), CANCELLED.
BakedFile bake_bent_file(const ImportedCharacter& character, CharacterModel model, const BentTask& task,
                         const StageReport& progress, const BakeIdentity& identity = {});

// Makes the model for a mesh with less detail from the baked model of the full mesh.

struct LodTask {
  std::size_t auto_poses = 200;
  std::size_t samples_per_clip = 8;
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
};

// Returns the identity of a call of bake_lod_file.
BakeIdentity identify_lod(const ImportedCharacter& lod, std::span<const std::byte> model_bytes,
                          const LodTask& task);

// `lod` must have the bones of the model in the same order, which is true for meshes of the same rig. The
// spheres, key points, levels and casters are copied from the model. The vertices are fitted to ray tracing
// of `lod` in automatic poses and in poses of the clips of `lod`. Progress reports the stage
// JobStage::raytrace and counts poses. Throws Failure: BAD_FILE (the bytes are not a model, or it has other
// bones), CANCELLED.
BakedFile bake_lod_file(const ImportedCharacter& lod, std::span<const std::byte> model_bytes,
                        const LodTask& task, const StageReport& progress);

}  // namespace nook::bake
