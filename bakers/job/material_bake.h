// Bakes a material: makes its task from a descriptor or a source, its file and its report.
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

// Says where a raw material comes from, and how to compress it: a traced meso-structure or a file.

struct MesoSource {
  material::MesoParameters meso;                        // a built-in structure
  std::optional<material::MesoSurface> tile;            // replaces meso
  std::uint32_t views = 100, lights = 0;                // numbers of directions; lights 0: as many as views
  float max_tilt_deg = material::default_max_tilt_deg;  // their largest angle to the normal, degrees
  material::TraceSettings trace;
};

// Traces the meso-structure from every pair of directions. progress counts views; throws Failure (CANCELLED)
// when it returns false.
material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress);

struct MaterialTask {
  std::optional<material::MesoParameters> meso;  // empty: measured data
  material::TraceSettings trace;                 // for meso
  // Directions and sizes, and all measured data except the gaps. The coverage defines them; see fill_gaps()
  // in raw_material.h.
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

// Chooses the settings from the images to fit: on the relief, if there is one.
using ChooseSettings = std::function<material::CompressionSettings(const material::RawMaterial& fitted)>;

// The recipe names `source`, and `relief_source`, the file of the heights, if it is not null, and holds the
// identity if that has text. Throws what choose throws, and Failure: CANCELLED.
CompressedMaterial compress_to_file(const material::RawMaterial& raw, material::ReliefSource relief,
                                    const ChooseSettings& choose, const nlohmann::ordered_json& source,
                                    const nlohmann::ordered_json& relief_source,
                                    const material::StageProgress& progress,
                                    const BakeIdentity& identity = {});

// Consumes the task's measured data. Throws Failure: INVALID_ARGUMENT (ranks that the data do not allow, a
// structure that cannot be built), CANCELLED.
BakedFile bake_material(MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
