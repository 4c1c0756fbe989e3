// Where a raw material comes from: a traced meso-structure or a file; and the settings of its compression.
#pragma once

#include <cstdint>
#include <optional>

#include "bakers/material/btf_file.h"
#include "bakers/material/compression.h"
#include "bakers/material/compression_settings.h"
#include "bakers/material/meso_surface.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/trace_material.h"

namespace nook::bake {

struct MesoSource {
  material::MesoParameters meso;                        // of a built-in structure
  std::optional<material::MesoSurface> tile;            // in its place
  std::uint32_t views = 100, lights = 0;                // directions; lights 0: as many as views
  float max_tilt_deg = material::default_max_tilt_deg;  // their largest angle to the normal, degrees
  material::TraceSettings trace;
};

// Traces the meso-structure from every pair of directions. progress counts views; throws Failure (CANCELLED)
// when it returns false.
material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress);

}  // namespace nook::bake
