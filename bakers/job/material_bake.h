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

// Says where a raw material comes from (a traced meso-structure or a file), and how to compress it.

struct MesoSource {
  material::MesoParameters meso;              // a built-in structure
  std::optional<material::MesoSurface> tile;  // if set, replaces `meso`
  std::uint32_t views = 100,
                lights = 0;  // counts of directions; if `lights` is 0, there are as many lights as views
  // Largest angle between a direction and the normal, degrees.
  float max_tilt_deg = material::default_max_tilt_deg;
  material::TraceSettings trace;
};

// Traces the meso-structure from every pair of directions. `progress` counts views. Throws Failure
// (CANCELLED) when it returns false.
material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress);

struct MaterialTask {
  std::optional<material::MesoParameters> meso;  // empty: measured data
  material::TraceSettings trace;                 // used if `meso` is set
  // Contains the directions and sizes. For measured data, it also contains the values, except in gaps.
  // `coverage` defines the gaps; see fill_gaps() in raw_material.h.
  material::RawMaterial raw;
  std::vector<float> coverage;  // empty: all 1
  material::CompressionSettings settings;
  bool ranks_given = false, votf_ranks_given = false;
  double rank_threshold = 0.01;
};

// Throws INVALID_ARGUMENT for unknown names and enum values, values that are out of range or not finite, and
// invalid directions.
MaterialTask material_task_of(const nook_bake_material_desc& desc);

struct CompressedMaterial {
  std::vector<std::byte> file;
  nlohmann::ordered_json row;     // figures of the file, for reports
  nlohmann::ordered_json recipe;  // recipe stored in the file, with the verdict
  material::Verdict verdict;
};

// A function that chooses the settings. Its argument contains the images to fit. If the material has a
// relief, these images are already projected onto it.
using ChooseSettings = std::function<material::CompressionSettings(const material::RawMaterial& fitted)>;

// The recipe stores the name `source`. If relief_source is not null, the recipe also stores this name of the
// height file. If `identity` is not empty, the recipe stores it too. Throws what `choose` throws, and
// Failure: CANCELLED.
CompressedMaterial compress_to_file(const material::RawMaterial& raw, material::ReliefSource relief,
                                    const ChooseSettings& choose, const nlohmann::ordered_json& source,
                                    const nlohmann::ordered_json& relief_source,
                                    const material::StageProgress& progress,
                                    const BakeIdentity& identity = {});

// Takes the measured data out of `task`, so call this only once per task. Throws Failure: INVALID_ARGUMENT
// (the ranks are not possible for the data, or the structure cannot be built), CANCELLED.
BakedFile bake_material(MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
