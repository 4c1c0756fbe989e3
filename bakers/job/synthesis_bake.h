// Bakes a coordinate texture for a material, and returns the bytes of a file and its report.
#pragma once

#include <nook/experimental/nook_bake_materials.h>

#include <span>
#include <string>

#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"
#include "bakers/synthesis/synthesise.h"

namespace nook::bake {

// The part of a material that may appear on the plane, in texels.
struct Crop {
  std::uint32_t x = 0, y = 0;
  std::uint32_t width = 0, height = 0;  // 0: the whole material
};

struct SynthesisTask {
  std::uint32_t width = 0, height = 0;  // size of the material, texels
  synthesis::Exemplar exemplar;         // made from the crop
  Crop crop;
  synthesis::SynthesisSettings settings;
  std::string source;         // the name of the source file, if there is one
  std::string material_hash;  // SHA-256 of the material's bytes
};

// Reads the appearance of texels from the bytes of a .nook file with a material or a raw material. Set
// is_tiling if the material tiles without a seam. A crop is always treated as not tiling. Throws Failure:
// INVALID_ARGUMENT (the crop exceeds the material, settings are out of range), BAD_FILE, FILE_VERSION.
SynthesisTask synthesis_task(std::span<const std::byte> material, const Crop& crop, bool is_tiling,
                             const synthesis::SynthesisSettings& settings);
// Throws what synthesis_task throws, and INVALID_ARGUMENT for a NULL material.
SynthesisTask synthesis_task_of(const nook_bake_synthesis_desc& desc);

// Returns the identity of a call of bake_synthesis_file.
BakeIdentity identify_synthesis(const SynthesisTask& task);

// Progress reports the stage JobStage::fit and counts texels. Throws Failure: CANCELLED.
BakedFile bake_synthesis_file(const SynthesisTask& task, const StageReport& progress);

}  // namespace nook::bake
