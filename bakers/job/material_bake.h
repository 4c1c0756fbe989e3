// Bakes a material: makes a task from a descriptor or a source, and makes the file and the report of a task.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"
#include "bakers/material/btf_file.h"
#include "bakers/material/compression.h"
#include "bakers/material/compression_settings.h"
#include "bakers/material/meso_surface.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/trace_material.h"
#include "bakers/material/verdict.h"

namespace nook::bake {

// Where a raw material comes from (a traced meso-structure or a file), and how to compress it.

struct MesoSource {
  material::MesoParameters meso;                        // a built-in structure
  std::optional<material::MesoSurface> tile;            // if set, replaces `meso`
  std::uint32_t views = 100, lights = 0;                // numbers of directions; if `lights` is 0, there are
                                                        // as many lights as views
  float max_tilt_deg = material::default_max_tilt_deg;  // largest angle of directions to the normal, degrees
  material::TraceSettings trace;
};

// Traces the meso-structure from every pair of directions. `progress` counts views. Throws Failure
// (CANCELLED) when it returns false.
material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress);

struct MaterialTask {
  std::optional<material::MesoParameters> meso;  // empty: measured data
  material::TraceSettings trace;                 // used if `meso` is set
  // Directions and sizes. For measured data, also the values, except in gaps. `coverage` defines the gaps;
  // see fill_gaps() in raw_material.h.
  material::RawMaterial raw;
  std::vector<float> coverage;  // empty: all 1
  material::CompressionSettings settings;
  bool ranks_given = false, votf_ranks_given = false;
  double rank_threshold = 0.01;
};

// Throws INVALID_ARGUMENT for unknown names and enum values, numbers that are out of range or not finite, and
// invalid directions.
MaterialTask material_task_of(const nook_bake_material_desc& desc);

struct CompressedMaterial {
  std::vector<std::byte> file;
  nlohmann::ordered_json row;     // figures of the file, for reports
  nlohmann::ordered_json recipe;  // recipe stored in the file, with the verdict
  material::Verdict verdict;
};

// Chooses the settings from the images to fit. If there is a relief, the images are projected onto it.
using ChooseSettings = std::function<material::CompressionSettings(const material::RawMaterial& fitted)>;

// The recipe contains the name `source`. If relief_source is not null, it also contains this name of the
// height file. If the identity is not empty, it contains the identity. Throws what `choose` throws, and
// Failure: CANCELLED.
CompressedMaterial compress_to_file(const material::RawMaterial& raw, material::ReliefSource relief,
                                    const ChooseSettings& choose, const nlohmann::ordered_json& source,
                                    const nlohmann::ordered_json& relief_source,
                                    const material::StageProgress& progress,
                                    const BakeIdentity& identity = {});

// Moves the measured data out of the task. Throws Failure: INVALID_ARGUMENT (ranks that are not possible for
// the data, a structure that cannot be built), CANCELLED.
BakedFile bake_material(MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
