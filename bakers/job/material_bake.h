// Makes the bytes of a .nook file and a report from a material task.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/job/baked_file.h"
#include "bakers/job/material_task.h"

namespace nook::bake {

struct CompressedMaterial {
  std::vector<std::byte> file;
  nlohmann::ordered_json row;     // the figures of the file, as reports show them
  nlohmann::ordered_json recipe;  // of the file
};

// Chooses the settings by the images that are fitted: on the relief, if there is one.
using ChooseSettings = std::function<material::CompressionSettings(const material::RawMaterial& fitted)>;

// The recipe names `source` and, where it is not null, `relief_source`, the file of the heights. Throws what
// choose throws, and Failure: CANCELLED.
CompressedMaterial compress_to_file(const material::RawMaterial& raw, material::ReliefSource relief,
                                    const ChooseSettings& choose, const nlohmann::ordered_json& source,
                                    const nlohmann::ordered_json& relief_source,
                                    const material::StageProgress& progress);

// Consumes the task's measured data. Throws Failure: INVALID_ARGUMENT (ranks that the data do not allow, a
// structure that cannot be built), CANCELLED.
BakedFile bake_material(MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
