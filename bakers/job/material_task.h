// The task of a material job, from its descriptor.
#pragma once

#include <nook/nook_bake.h>

#include <optional>
#include <vector>

#include "bakers/material/compression.h"
#include "bakers/material/meso_surface.h"
#include "bakers/material/trace_material.h"

namespace nook::bake {

struct MaterialTask {
  std::optional<material::MesoParameters> meso;  // empty: measured data
  material::TraceSettings trace;                 // of meso
  // Directions and sizes, and all measured data except for the gaps, which coverage defines; see fill_gaps.h.
  material::RawMaterial raw;
  std::vector<float> coverage;  // empty: all 1
  material::CompressionSettings settings;
  bool ranks_given = false, votf_ranks_given = false;
  double rank_threshold = 0.01;
};

// Throws INVALID_ARGUMENT for unknown names and enum values, numbers that are out of range or not finite, and
// invalid directions.
MaterialTask material_task_of(const nook_bake_material_desc& desc);

}  // namespace nook::bake
