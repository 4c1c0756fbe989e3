#include "bakers/job/material_source.h"

namespace nook::bake {

material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress) {
  const material::MesoSurface surface = source.tile ? *source.tile : material::make_meso_surface(source.meso);
  const auto lights =
      material::spiral_directions(source.lights ? source.lights : source.views, source.max_tilt_deg);
  const auto views = material::spiral_directions(source.views, source.max_tilt_deg);
  material::RawMaterial raw = material::trace_material(surface, lights, views, source.trace, progress);
  raw.name = source.meso.name;
  return raw;
}

}  // namespace nook::bake
